"""Pictures by matplotlib. Each function draws into `axes`, new ones by default, and returns them."""

import numpy as np
from matplotlib import pyplot


def draw(axes, table, start, values, quantity, **style):
    """Draw values over the longest of the coordinates start + x, y, z: sections as lines in the
    order of this coordinate, faces in space as colours over the two longest ones."""
    axes = axes or pyplot.subplots(layout="constrained")[1]
    names = [start + axis for axis in "xyz" if start + axis in table]
    rows = np.array([table[name] for name in names])
    longest = np.argsort(-np.ptp(rows, axis=1), kind="stable")
    axes.set_xlabel(names[longest[0]])
    if len(names) == 2:
        order = np.argsort(rows[longest[0]])
        axes.plot(rows[longest[0]][order], np.asarray(values)[order], **style)
        axes.set_ylabel(quantity)
    else:
        colours = axes.tripcolor(*rows[longest[:2]], np.asarray(values), shading="gouraud", **style)
        axes.figure.colorbar(colours, ax=axes, label=quantity)
        axes.set_ylabel(names[longest[1]])
        axes.set_aspect("equal")
    return axes


def pressure(contact, axes=None, **style):
    """Draw the pressure of a contact table of a Result or a Run."""
    return draw(axes, contact, "", contact["pressure"], "contact pressure", **style)


def shape(run, axes=None, **style):
    """Draw the displacement of the shaped faces of a Run, from its profile.csv."""
    profile = run.table("profile.csv")
    return draw(axes, profile, "reference_", profile["move"], "displacement of the face", **style)


def convergence(run, axes=None, **style):
    """Draw the objective of a Run and, on a logarithmic axis, the norm of the projected gradient."""
    axes = axes or pyplot.subplots(layout="constrained")[1]
    history = run.history
    axes.plot(history["evaluations"], history["objective"], "o-", **style)
    axes.set_xlabel("evaluations")
    axes.set_ylabel("objective")
    other = axes.twinx()
    other.semilogy(history["evaluations"], history["projected_gradient"], "k:")
    other.set_ylabel("projected gradient (dotted)")
    return axes
