"""Rows about searches, limits and derivatives, and scenes of files and of other studies."""

from runs import changed, section

from cases import Figure
from outcomes import ALL, ONE, SOLVERS, Refused, Row, Solved
from rollers import cylinders, rollers, spheres
from round_bodies import PINS, RINGS, SHELLS
from scenes import blocks, force


def known(case, name=None, methods=SOLVERS, quick=False):
    """Return the row of a neighbour with its figures."""
    return Row(name or f"{case.family}, {case.setting}", case.text, Solved(case.asked), methods,
               False, case.mesh, quick)


def dense(name, methods=SOLVERS, quick=False):
    return Row(f"tests/scenes/{name}.prm", changed(f"tests/scenes/{name}.prm", {}), Solved(),
               methods, True, None, quick)


FILES = [
    dense("beyond-edges"), dense("soft-layer", ALL), dense("leaning-stack", ALL),
    Row("tests/scenes/pull-off.prm", changed("tests/scenes/pull-off.prm", {}),
        Refused(3, "no equilibrium: body punch is not held against its load along translation (0 0 1)")),
    Row("tests/scenes/tipping.prm", changed("tests/scenes/tipping.prm", {}),
        Refused(3, "no equilibrium: body punch is not held against its load")),
    Row("tests/scenes/solver-entries.prm", changed("tests/scenes/solver-entries.prm", {}),
        Solved(force(20, component=2)), ALL),
    *map(known, (RINGS[0], RINGS[10], RINGS[11], PINS[1], PINS[3], PINS[11], SHELLS[2])),
    known(rollers(cylinders), "cylinders, graded to 1:32"),
    known(rollers(spheres, cells=(4, 5), levels=(4, 4)), "spheres as sections, graded to 1:16"),
]

BARS, BLOCKS = "tests/scenes/two-bars.prm", "tests/scenes/two-blocks-2d.prm"


def search(path, **entries):
    return changed(path, {"Task": "optimize", **entries})


def compliance(value, bound):
    return lambda result: [Figure("compliance", result.summary["optimization"][
        "objective_final"], value, bound)]


def tight(algorithm):
    """Return the row of heights between 0.9 and 1.1, the right ones being 2/3 and 4/3: both end at a bound, as
    areas of 2 mm^2 in all do. Compliance of a bar: F^2 L / EA."""
    return Row(f"design at its bounds, {algorithm}",
               search(BARS, **{"Shape lower/Bounds": "-.1, .1", "Shape upper/Bounds": "-.1, .1",
                               "Optimization/Algorithm": algorithm}),
               Solved(compliance(2e-3 * (1 / .9 + 4 / 1.1), 1e-4)), ONE, quick=algorithm == "MMA")


def at_bound(algorithm):
    """Return the row of a search that begins at bounds and ends at the right heights."""
    return Row(f"starts at its bounds, {algorithm}",
               search(BARS, **{"Shape lower/Initial": ".9", "Shape upper/Initial": "-.9",
                               "Optimization/Algorithm": algorithm}),
               Solved(compliance(9e-3, 1e-4)), ONE)


def rest(result):
    """Nothing presses, so the energy is that of rounding."""
    return [Figure("energy", result.state["energy"], 0., 1e-12)]


def gradient_zero(result):
    values = result.summary["gradient"]["values"]
    return [Figure("gradient", max(map(abs, values)), 0., 1e-12)]


def volume_gradient(result):
    """The gradients of 3 heights of a quadratic Bezier patch of width 1 have the sum 1."""
    return [Figure("gradient", sum(result.summary["gradient"]["values"]), 1., 1e-8)]


def sensitivity(**entries):
    return changed(BLOCKS, {"Task": "sensitivity", "Gradient/Compare": "false", **entries})


def rocking(cases):
    """Return a block that is pressed on the left, pulled there, pressed again, and so on."""
    names = [f"c{i}" for i in range(cases)]
    text = blocks({"Box cells": "8, 4", "Pressure": "", "Supports": "left: x"},
                  {"Box cells": "8, 4", "Supports": "bottom: xy"}, Load_cases=", ".join(names))
    return text + "".join(section(f"Load case {name}", {
        "Traction": f"upper.top: 0 {'5*x-6' if i % 2 else '-1-5*x'}"})
        for i, name in enumerate(names))


def rocks(result):
    """Each load case carries 3.5."""
    return [Figure(f"force of {case['name']}", case["state"]["contact_force"][1], 3.5, 1e-4)
            for case in result.summary["load_cases"]]


def ends(reason):
    return lambda result: [Figure(f"stops by {reason}", float(
        result.summary["optimization"]["stop_reason"] == reason), 1., 0.)]


BUSH = {"Optimization/Constraints": "vb: <= initial", "Responses": "peak, vb",
        "Response vb/Quantity": "volume", "Response vb/Body": "bush"}

SEARCHES = [
    Row("no F-mult allowed but 3", blocks(dim=3, solver={"Maximum F-mults": 3}),
        Refused(3, "F-mults; increase 'Maximum F-mults'"), quick=True),
    Row("one evaluation, limits met", search(BLOCKS, **{"Optimization/Maximum evaluations": 1}),
        Solved(ends("maximum evaluations")), ONE),
    Row("one evaluation, a limit broken",
        search(BLOCKS, **{"Optimization/Maximum evaluations": 1,
                          "Optimization/Constraints": "volume: = 1.5 initial"}),
        Refused(3, "violates"), ONE, quick=True),
    Row("no evaluation allowed", search(BLOCKS, **{"Optimization/Maximum evaluations": 0}),
        Refused(2, "Maximum evaluations"), ONE),
    *map(tight, ("SQP", "MMA")),
    *map(at_bound, ("SQP", "MMA")),
    Row("bounds without room", search(BLOCKS, **{"Shape/Bounds": "0, 0"}),
        Refused(2, "Bounds"), ONE),
    Row("loads rock a block: its contacts open and close", rocking(6), Solved(rocks),
        quick=True),
    Row("a search opens and closes contacts",
        search(BLOCKS, **{"Shape/Control points": 8, "Optimization/Objective": "peak pressure",
                          "Optimization/Maximum evaluations": 40}), methods=ONE),
    *(Row(f"degenerate start: the gradient of a limit is rounding, {algorithm}",
          search("prm/bush.prm", **{"Optimization/Algorithm": algorithm, **BUSH,
                                    "Optimization/Maximum evaluations": 30,
                                    "Body pin/Cells": "48, 6", "Body bush/Cells": "48, 4"}),
          Solved(lambda result: [Figure("gain", float(
              result.summary["optimization"]["objective_final"] <
              .8 * result.summary["optimization"]["objective_initial"]), 1., 0.)]), ONE)
      for algorithm in ("SQP", "MMA")),
    Row("degenerate start: weakly active contacts",
        sensitivity(**{"Contact/Gap": ".02*x^2", "Body upper/Curved faces": "",
                       "Body upper/Pressure": "", "Body upper/Displacement": "top: y = 0",
                       "Optimization/Objective": "compliance"}), methods=ONE),
    Row("without gradient: a volume, adjoint",
        sensitivity(**{"Gradient/Method": "adjoint", "Optimization/Objective": "volume",
                       "Optimization/Constraints": ""}),
        Solved(volume_gradient), ONE),
    Row("without gradient: pressure where nothing touches",
        sensitivity(**{"Gradient/Method": "adjoint", "Optimization/Objective": "peak pressure",
                       "Contact/Gap": 10, "Body upper/Supports": "top: xy"}),
        Solved(gradient_zero), ONE),
    Row("without gradient: a search from there",
        search(BLOCKS, **{"Optimization/Objective": "peak pressure", "Contact/Gap": 10,
                          "Body upper/Supports": "top: xy"}), Solved(rest), ONE),
    Row("without gradient: the shape is none of a body that matters",
        sensitivity(**{"Shape/Fixed": "0, 1, 2", "Optimization/Objective": "compliance"}),
        Refused(2, "Fixed"), ONE),
]

ROWS = [*FILES, *SEARCHES]
