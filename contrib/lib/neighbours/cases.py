"""Scenes made of numbers, their runs, and what is asked of their figures."""

import collections
import functools
import math
import pathlib
import subprocess
import tempfile

from gallery_runs import Result, launch

# setting: what tells it from its neighbours; text: of the parameter file; asked: the
# figures of a Result; mesh: makes the bytes of mesh.msh beside it, None if it cannot.
Case = collections.namedtuple("Case", "family setting text asked ranks mesh",
                              defaults=[1, None])
# bound: on |found / right - 1|, or on |found| where right is 0.
Figure = collections.namedtuple("Figure", "name found right bound")
# status: of the program; -1: stopped, it took too long
Run = collections.namedtuple("Run", "status message result")

SECONDS = 300


def error(figure):
    return abs(figure.found / figure.right - 1 if figure.right else figure.found)


def section(title, entries):
    return (f"subsection {title}\n" +
            "".join(f"  set {name} = {value}\n" for name, value in entries.items()) +
            "end\n")


def scene(bodies, contact, decomposition=None, **entries):
    """The text of a parameter file; entries have blanks for underscores."""
    lines = [f"set {name.replace('_', ' ')} = {value}\n"
             for name, value in {"Bodies": ", ".join(bodies), **entries}.items()]
    return "".join(lines + [section(f"Body {name}", body)
                            for name, body in bodies.items()] +
                   [section("Contact", contact),
                    section("Decomposition", decomposition or {})])


@functools.lru_cache(maxsize=None)
def run(text, ranks=1, mesh=None):
    """What a scene ends with, and its line of error. mesh: the bytes of mesh.msh."""
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        (directory / "scene.prm").write_text(text)
        if mesh:
            (directory / "mesh.msh").write_bytes(mesh)
        try:
            process = launch(directory / "scene.prm", [], directory / "output", ranks,
                             stderr=subprocess.PIPE, text=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return Run(-1, f"not ended after {SECONDS} s", None)
        message = next((line for line in process.stderr.splitlines()
                        if line.startswith("snug: ")), "")
        result = None if process.returncode else Result(directory / "output")
        return Run(process.returncode, message, result)


def label(**settings):
    """'subdomains 3, ranks 2' of those that are not None."""
    return ", ".join(f"{name.replace('_', ' ')} {value}"
                     for name, value in settings.items() if value is not None)


def mean_pressure(result):
    return (math.fsum(p["force"] for p in result.points) /
            math.fsum(p["area"] for p in result.points))


def torque(result, radius, bound=1e-9):
    """About the origin, that of the pressure on round faces about it, over the sum of
    all forces times their radius."""
    pair = result.state["pairs"][0]
    # moments have three components in 2D too
    x, f = ([*pair[name], 0.][:3] for name in ("centre", "force"))
    about = [pair["moment"][i] + x[(i + 1) % 3] * f[(i + 2) % 3] -
             x[(i + 2) % 3] * f[(i + 1) % 3] for i in range(3)]
    forces = math.fsum(abs(p["force"]) for p in result.points)
    return Figure("torque", math.hypot(*about) / (forces * radius), 0., bound)


def warned(result, of="is nodal, but"):
    warnings = [text for text in result.summary["warnings"] if of in text]
    return Figure(f"warnings ({of})", float(len(warnings)), 1., 0.)
