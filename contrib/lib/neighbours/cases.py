"""Cases, which are scenes made of numbers, and the figures that are asked of their results."""

import collections
import functools
import inspect
import math
import sys

from runs import print_head, print_row, run_once

# setting: what tells a case from its neighbours; text: of the parameter file; asked: returns the
# figures of a Result; mesh: makes the bytes of mesh.msh beside the file, None if it cannot.
Case = collections.namedtuple("Case", "family setting text asked ranks mesh", defaults=[1, None])
# bound: on |found / right - 1|, or on |found| where right is 0.
Figure = collections.namedtuple("Figure", "name found right bound")


def error(figure):
    """Return the error of a figure, relative unless the right value is zero."""
    return abs(figure.found / figure.right - 1 if figure.right else figure.found)


def label(settings):
    """Return 'subdomains 3, ranks 2' for settings by name, without those that are None."""
    return ", ".join(f"{name.replace('_', ' ')} {value}"
                     for name, value in settings.items() if value is not None)


def family(name, head):
    """Return a decorator of functions that return (text, asked) or (text, asked, mesh) for some
    settings: with it they return Cases of the family, also for so many ranks. What tells a case
    from its neighbours are the settings of the head, the part, and all that are not the
    default."""
    def decorator(make):
        signature = inspect.signature(make)

        @functools.wraps(make)
        def case(*numbers, ranks=1, **settings):
            given = signature.bind(*numbers, **settings)
            given.apply_defaults()
            shown = {key: value for key, value in given.arguments.items()
                     if "{" + key + "}" not in head and
                     (key == "part" or value != signature.parameters[key].default)}
            text, asked, *mesh = make(*numbers, **settings)
            return Case(name, f"{head.format(**given.arguments)} " + label(
                {**shown, "ranks": ranks}), text, asked, ranks, *mesh)
        return case
    return decorator


def torque(result, radius, bound=1e-9):
    """Return as a figure the moment of the pressure on round faces about their centre, the
    origin, over the sum of all forces times the radius."""
    pair = result.state["pairs"][0]
    # moments have three components in 2D too
    x, f = ([*pair[name], 0.][:3] for name in ("centre", "force"))
    about = [pair["moment"][i] + x[(i + 1) % 3] * f[(i + 2) % 3] -
             x[(i + 2) % 3] * f[(i + 1) % 3] for i in range(3)]
    forces = math.fsum(abs(p["force"]) for p in result.points)
    return Figure("torque", math.hypot(*about) / (forces * radius), 0., bound)


def warned(result, of="is nodal, but"):
    """Return the figure that one warning has these words."""
    warnings = [text for text in result.summary["warnings"] if of in text]
    return Figure(f"warnings ({of})", float(len(warnings)), 1., 0.)


def print_head_of_figures():
    """Print the head of the table of which examine() prints the rows."""
    print_head("scene", "setting", "figure", "found", "right", "error", "bound", "status",
               "F-mults", "warnings")


def examine(case):
    """Print the rows of a case, and return what is wrong with it as messages."""
    name = f"{case.family}, {case.setting}"
    mesh = case.mesh() if case.mesh else None
    if case.mesh and not mesh:
        print(f"{name}: left out, there is no Gmsh", file=sys.stderr)
        return []
    done = run_once(case.text, ranks=case.ranks, mesh=mesh)
    if not done.result:
        print_row(case.family, case.setting, done.message, *4 * "-", done.status, "-", "-")
        return [f"{name}: status {done.status}, {done.message}"]
    wrong = []
    for figure in case.asked(done.result):
        off = error(figure)
        print_row(case.family, case.setting, figure.name, f"{figure.found:.6g}",
                  f"{figure.right:.6g}", f"{off:.1e}", f"{figure.bound:.1e}", done.status,
                  done.result.state["f_mults"], len(done.result.summary["warnings"]))
        # not >: nan, where the right value is not known, is wrong
        if not off <= figure.bound:
            wrong.append(f"{name}: {figure.name} is {figure.found:.6g} instead of "
                         f"{figure.right:.6g}")
    return wrong
