"""Cases, which are scenes made of numbers, and the figures that are asked of their results."""

import collections
import functools
import inspect
import math

from runs import print_head, print_row, run_once, scene

# setting: what tells a case from its neighbours; text: of the parameter file; asked: returns the
# figures of a Result; mesh: returns the bytes of mesh.msh beside the file.
Case = collections.namedtuple("Case", "family setting text asked ranks mesh", defaults=[1, None])
# bound: on |found / right - 1|, or on |found| where right is 0.
Figure = collections.namedtuple("Figure", "name found right bound")


def error(figure):
    """Return the error of a figure, relative unless the right value is zero."""
    return abs(figure.found / figure.right - 1 if figure.right else figure.found)


def label(settings):
    """Return 'subdomains 3, ranks 2' for settings by name."""
    return ", ".join(f"{name} {value}" for name, value in settings.items())


def family(name, head):
    """Return a decorator of functions that return (text, asked) or (text, asked, mesh) for some
    settings: with it they return Cases of the family, also for so many ranks. What tells a case
    from its neighbours are the settings of the head, the part, and all others that are given."""
    def decorator(make):
        signature = inspect.signature(make)

        @functools.wraps(make)
        def case(*numbers, ranks=1, **settings):
            given = signature.bind(*numbers, **settings)
            named = [key for key in given.arguments if "{" + key + "}" in head]
            shown = {key: value for key, value in given.arguments.items()
                     if key not in (*named, "settings")}
            given.apply_defaults()
            if "part" in signature.parameters:
                shown = {"part": given.arguments["part"], **shown}
            shown.update(given.arguments.get("settings", {}))
            text, asked, *mesh = make(*numbers, **settings)
            return Case(name, f"{head.format(**given.arguments)} " + label(
                {**shown, "ranks": ranks}), text, asked, ranks, *mesh)
        return case
    return decorator


def contact_scene(bodies, contact, degree=1, method="auto", slave="finer", subdomains="auto",
                  **entries):
    """Return the text of bodies in contact with the settings that all families have."""
    return scene(bodies, {**contact, "Method": method, "Slave": slave},
                 {"Subdomains": subdomains}, Element_degree=degree, **entries)


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
    done = run_once(case.text, ranks=case.ranks, mesh=case.mesh and case.mesh())
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
