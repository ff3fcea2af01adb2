"""Charts of gradients: errors against steps, slenderness, tolerance, and across a weakly active
contact."""

import functools

import drawing
from matplotlib.ticker import MaxNLocator

from common import (BEAM, BLOCKS, COMPLIANCE, HERTZ_2D, HERTZ_3D, add_legend, by, compared,
                    curves, error, gradient, legend_below, numbers, panels, tolerance)
from runs import RunError, print_table, solve

# Errors against steps. The line contact has nine heights under the cylinder.
STEP_SCENES = {
    "2D Hertz, 9 heights": (HERTZ_2D, {
        "Shape/Basis": "Bezier patch", "Shape/Face": "plane.top", "Shape/Control points": "9",
        "Shape/Direction": "0, 1", "Shape/Bounds": "-0.25, 0.25"}),
    "3D Hertz, 9 heights": (HERTZ_3D, {})}

# Derivatives of the data and overall differences of one run.
STENCILS = (("forward differences", "forward"), ("central differences", "central"),
            ("refined forward differences", None),
            ("refined central differences", "fourth order"))


def at_step(name, entries, step, derivatives, stencil):
    """Return the rows of one step, none if it is too large for the mesh or the contacts."""
    try:
        found = compared(STEP_SCENES[name][0], {
            **entries, "Gradient/Derivatives": derivatives, "Gradient/Semi-analytic step": step,
            "Gradient/Differences": stencil or "forward",
            "Gradient/Step": step if stencil else "1e-3"})
    except RunError:
        return []
    shown = {"semi-analytic, " + derivatives.replace(" differences", ""): "semi-analytic"}
    if stencil:
        shown["overall, " + stencil] = "finite differences"
    if derivatives == "forward differences":
        shown["adjoint against direct"] = "adjoint"
    exact = found["direct"]["values"]
    return [{"scene": name, "method": title, "step": float(step),
             "error of dJ": error(found[method]["values"], exact),
             "error of u'": found[method]["displacement_difference"] or 0.}
            for title, method in shown.items()]


def step_rows(quick):
    rows = []
    for name, (_, entries) in list(STEP_SCENES.items())[:1 if quick else 2]:
        entries = {**entries, **COMPLIANCE, **tolerance("1e-10" if quick else "1e-12")}
        for exponent in (4,) if quick else range(1, 11):
            for stencil in STENCILS:
                rows += at_step(name, entries, f"1e-{exponent}", *stencil)
    return rows


def draw_steps(output, quick):
    rows = numbers(output / "gradient-steps.csv", lambda: step_rows(quick))
    print_table(rows)
    scenes = by(rows, "scene")
    figure, axes = panels(len(scenes), 5.)
    for axis, (scene, group) in zip(axes, scenes.items()):
        curves(axis, group, "method", "step", "error of dJ")
        axis.set_title(scene, fontsize="medium")
        axis.set_ylabel("relative error of dJ")
    figure.suptitle("Error against step: of cell size (semi-analytic), of bound width (overall)")
    legend_below(figure, axes, 4, .12)
    drawing.save(figure, output, "gradient-steps.png")


# Errors against slenderness. The reference of a beam of square cells is dC/dlog L of the same
# finite element problem, solved with fifty digits and differences of 1e-12.
REFERENCE = {5: 1.3566656541702452, 10: 10.862394737716589, 20: 87.081058826336765,
             40: 697.66721091784804, 80: 5585.9948107579618, 160: 44707.751193066554,
             320: 357743.50868819720}
SLENDER = {"exact": ("exact", "1e-5"),
           "forward": ("forward differences", "1e-5"),
           "central": ("central differences", "1e-4"),
           "refined forward": ("refined forward differences", "1e-5"),
           "refined central": ("refined central differences", "1e-4")}


def slender_rows(slenderness):
    """Return rows of the error of dC/dL of a beam of square cells."""
    # Forces of a chain of subdomains lose digits with its length only: five are enough.
    entries = {"Accept large displacements": "true",
               "Body beam/Box size": f"{slenderness}, 1",
               "Body beam/Box cells": f"{slenderness}, 1",
               "Decomposition/Subdomains": "5" if slenderness >= 20 else "1",
               **tolerance("1e-5")}
    for name, (derivatives, step) in SLENDER.items():
        found = gradient(BEAM, {**entries, "Gradient/Derivatives": derivatives,
                                "Gradient/Semi-analytic step": step}, "adjoint")
        value = found.summary["gradient"]["values"][0]
        yield {"L/H": slenderness, "derivatives": name, "step": float(step),
               "error": abs(value / REFERENCE[slenderness] - 1)}


def draw_slender(output, quick):
    rows = numbers(output / "gradient-slender.csv", lambda: [
        row for slenderness in ((5, 20) if quick else REFERENCE)
        for row in slender_rows(slenderness)])
    print_table(rows)
    figure, (axis,) = panels(1, 5.)
    for row in rows:
        row["label"] = row["derivatives"] + (
            "" if row["derivatives"] == "exact" else f", step {row['step']:g}")
    curves(axis, rows, "label", "L/H", "error")
    forward = by(rows, "derivatives")["forward"]
    places = [row["L/H"] for row in forward]
    axis.loglog(places, [0.5 * forward[0]["error"] * (place / places[0])**2
                         for place in places], "k:", label="(L/H)²")
    axis.set_ylabel("relative error of dC/dL")
    axis.set_title("Cantilever, length as variable")
    axis.set_xticks(places, [f"{place:g}" for place in places])
    axis.minorticks_off()
    add_legend(axis)
    drawing.save(figure, output, "gradient-slender.png")


# Errors against the tolerance of the state.

def tolerance_rows(objective, exponent, reference):
    """Return the rows of all methods for states solved to a tolerance."""
    given = {"Optimization/Objective": objective, **tolerance(f"1e-{exponent}"),
             "Gradient/Step": "1e-4"}
    found = {}
    for stencil in ("forward", "central"):
        methods = compared(HERTZ_3D, {**given, "Gradient/Differences": stencil})
        differences = methods.pop("finite differences")
        found.update({**methods, f"overall, {stencil}": differences})
    return [{"tolerance": 10.**-exponent, "method": method,
             "error of dJ": error(row["values"], reference)} for method, row in found.items()
            if (objective == "compliance") == (method != "energy")]


def all_tolerance_rows(quick):
    rows = []
    for objective in ("compliance", "potential energy"):
        exact = compared(HERTZ_3D, {"Optimization/Objective": objective, **tolerance("1e-13")})
        for exponent in (6,) if quick else range(2, 13):
            rows += tolerance_rows(objective, exponent, exact["direct"]["values"])
    return rows


def draw_tolerances(output, quick):
    rows = numbers(output / "gradient-tolerances.csv", lambda: all_tolerance_rows(quick))
    print_table(rows)
    figure, (axis,) = panels(1, 5.)
    curves(axis, rows, "method", "tolerance", "error of dJ")
    axis.set_xlabel("tolerance of the state")
    axis.set_ylabel("relative error of dJ")
    axis.set_title("3D Hertz, 9 heights; steps of overall differences 1e-4")
    add_legend(axis)
    drawing.save(figure, output, "gradient-tolerances.png")


# Across a weakly active contact.
PRESSURE = 20.  # near which a contact is to open


def under(pressure):
    """Return the entries of a pressure on the upper block."""
    return {**COMPLIANCE, **tolerance("1e-13"), "Shape/Control points": "4",
            "Body upper/Pressure": f"top: {pressure!r}"}


def vanishing(pressure, below):
    """Return per contact the load at which its force vanishes, from those at two loads: as
    long as contacts stay what they are, forces are linear in the load."""
    now, before = ([point["force"] for point in
                    solve(BLOCKS, {**under(load), "Task": "state"}).points]
                   for load in (pressure, below))
    slopes = [(a - b) / (pressure - below) for a, b in zip(now, before)]
    return [pressure - force / slope if force > 0. and slope > 0. else 0.
            for force, slope in zip(now, slopes)]


def weakening_pressure():
    """Return the load at which a contact has neither force nor gap. The nearer, the more
    digits of its force count."""
    loads = vanishing(PRESSURE, 0.999 * PRESSURE)
    contact = loads.index(max(loads))
    load = loads[contact]
    for distance in (1e-3, 1e-6):
        load = vanishing((1. + 2. * distance) * load, (1. + distance) * load)[contact]
    return load


def side_rows(load):
    """Return per variable all derivatives at the weak contact."""
    found = {stencil: compared(BLOCKS, {**under(load), "Gradient/Differences": stencil,
                                        "Gradient/Step": "1e-5"})
             for stencil in ("forward", "backward", "central")}
    columns = {"QP, up": ("central", "one-sided, up"),
               "differences, up": ("forward", "finite differences"),
               "QP, down": ("central", "one-sided, down"),
               "differences, down": ("backward", "finite differences"),
               "strong set": ("central", "adjoint"),
               "central differences": ("central", "finite differences")}
    return [{"variable": j, **{name: found[stencil][method]["values"][j]
                               for name, (stencil, method) in columns.items()}}
            for j in range(len(found["central"]["adjoint"]["values"]))]


def path_rows(load, j, quick):
    """Return the derivatives by variable j at loads about the weak one."""
    rows = []
    for place in (-1, 1) if quick else [0.1 * k for k in range(-10, 11) if k != 0]:
        row = {"load": 0.02 * place}
        for name, method, objective in (("compliance", "adjoint", "compliance"),
                                        ("energy", "energy", "potential energy")):
            entries = {**under((1. + row["load"]) * load), "Optimization/Objective": objective}
            row[name] = gradient(BLOCKS, entries, method).summary["gradient"]["values"][j]
        rows.append(row)
    return rows


def draw_weak(output, quick):
    load = functools.cache(weakening_pressure)
    sides = numbers(output / "gradient-weak.csv", lambda: side_rows(load()))
    widest = max(sides, key=lambda row: abs(row["QP, up"] - row["QP, down"]))
    path = numbers(output / "gradient-weak-path.csv",
                   lambda: path_rows(load(), widest["variable"], quick))
    print_table([{key: f"{value:.6f}" if isinstance(value, float) else value
                  for key, value in row.items()} for row in sides])
    figure, (compliance, energy) = panels(2)
    parts = {compliance: [[row for row in path if row["load"] < 0.],
                          [row for row in path if row["load"] > 0.]], energy: [path]}
    for axis, name in ((compliance, "compliance"), (energy, "energy")):
        for number, part in enumerate(parts[axis]):
            axis.plot([row["load"] for row in part], [row[name] for row in part], "C0.-",
                      markersize=4, label=None if number else "gradient of a state")
        axis.set_xlabel("load over that of the weak contact, less 1")
        axis.xaxis.set_major_locator(MaxNLocator(5))
        axis.grid(True, alpha=0.3)
    for name, style in (("QP, up", "C1^"), ("QP, down", "C1v"),
                        ("strong set", "C2+"), ("central differences", "C3x")):
        compliance.plot(0., widest[name], style, markersize=8, label=name, fillstyle="none")
    compliance.set_title("compliance, by the adjoint method")
    energy.set_title("potential energy")
    compliance.set_ylabel(f"derivative by height {widest['variable']:g}")
    compliance.legend(fontsize="small")
    figure.suptitle("Across a weakly active contact")
    drawing.save(figure, output, "gradient-weak.png")


CHARTS = {"steps": draw_steps, "slender": draw_slender, "tolerances": draw_tolerances,
          "weak": draw_weak}
