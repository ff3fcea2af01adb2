"""Rows about what touches: too little, too much, and in odd places."""

from runs import scene

from cases import Figure
from outcomes import ALL, ONE, SOLVERS, Refused, Row, Solved
from scenes import blocks, energy, even, force, hump, nothing_touches, sinks, tetrahedra

BOTH = sinks((1, 1), (1000, 1000), (.3, .3))


# Strains of this size are for robustness: the linear answer is known.
LARGE = {"Accept_large_displacements": "true"}


def held(gap, dim=2, **contact):
    """Return two blocks held at top and bottom, which overlap by -gap."""
    planes, last = ("left: x", "y") if dim == 2 else ("left: x, front: y", "z")
    return blocks({"Pressure": "", "Supports": f"{planes}, top: {last}"}, dim=dim,
                  contact={"Gap": gap, "Interference": "true", **contact}, **LARGE)


def squeezed(overlap):
    """Return the pressure in held blocks that overlap."""
    return overlap / sinks((1, 1), (1000, 1000), (.3, .3))


def tight(bodies, pairs, contact=None, obstacles=None, dim=2, sections=None, **entries):
    """Return bodies in contact, solved well enough for dense algebra."""
    return scene(bodies, {"Pairs": pairs, **(contact or {})}, obstacles=obstacles,
                 sections={"Solver": {"Relative tolerance": 1e-9}, **(sections or {})},
                 Dimension=dim, **entries)


FLOOR = {"floor": {"Normal": "0, 1"}}
TWICE = "block.bottom: floor, block.bottom: again"


def on_planes(body, planes, pairs="block.bottom: floor", contact=None, dim=2):
    """Return a block on rigid planes."""
    return tight({"block": {"Box cells": ", ".join(["4"] * dim), "Young's modulus": 1000, **body}},
                 pairs, contact, planes, dim)


BELOW = "left.bottom: lower.top, right.bottom: lower.top"
ABOVE = "lower.top: left.bottom, lower.top: right.bottom"


def two_punches(times=1, pairs=BELOW, **contact):
    """Return two punches side by side on one block, whose nodes between them belong to both; so
    many times as fine."""
    punch = {"Box size": ".5, 1", "Box cells": f"{3 * times}, {3 * times}",
             "Young's modulus": 1000, "Pressure": "top: 1"}
    return tight({"left": {**punch, "Box corner": "0, 1", "Supports": "left: x"},
                  "right": {**punch, "Box corner": ".5, 1", "Supports": "right: x"},
                  "lower": {"Box cells": f"{8 * times}, {4 * times}", "Young's modulus": 1000,
                            "Supports": "bottom: xy"}}, pairs, contact)


def floating(text):
    return text.replace("Supports = left: x\n", "Supports =\n")


FREE = [
    Row("pulled off", blocks({"Pressure": "top: -1"}),
        Refused(3, "no equilibrium: body upper is not held against its load along translation (0 1)")),
    Row("pulled off by 1e-9", blocks({"Pressure": "top: -1e-9"}),
        Refused(3, "no equilibrium: body upper is not held against its load along translation (0 1)")),
    Row("pulled off, solid", blocks({"Pressure": "top: -1"}, dim=3),
        Refused(3, "no equilibrium: body upper is not held against its load along translation (0 0 1)")),
    Row("pulled with half of its weight", blocks({"Pressure": "top: -.5", "Body force": "0 -1"}),
        Solved(force(.5)), quick=True),
    Row("pulled with all of its weight", blocks({"Pressure": "top: -1", "Body force": "0 -1"}),
        Solved(lambda result: [Figure("force", result.state["contact_force"][1], 0., 1e-6)])),
    Row("pushed aside where nothing holds",
        floating(blocks({"Traction": "top: .1 0"})),
        Refused(3, "no equilibrium: body upper is not held against its load along translation (1 0)"), quick=True),
    Row("tips over the edge", blocks({"Box corner": ".6, 1", "Supports": ""}),
        Refused(3, "no equilibrium: body upper is not held against its load")),
    Row("tips over the edge, solid, on rollers",
        blocks({"Box corner": ".6, 0, 1", "Box cells": "2, 3, 2", "Supports": "front: y"},
               {"Box cells": "2, 2, 2", "Supports": "bottom: xyz"}, {"Slave": "first"}, dim=3),
        Refused(3, "no equilibrium: body upper is not held against its load"), quick=True),
    Row("free to slide", floating(blocks(lower={"Supports": "bottom: xy"},
                                         solver={"Relative tolerance": 1e-9})),
        dense=True, quick=True),
    Row("free to slide and turn, solid",
        blocks({"Supports": "", "Box cells": "2, 2, 2"},
               {"Supports": "bottom: xyz", "Box cells": "3, 3, 2"}, dim=3,
               solver={"Relative tolerance": 1e-9}), dense=True),
    Row("floats, squeezed from both sides",
        blocks({"Box corner": ".3, 1", "Box size": ".7, .3", "Box cells": "7, 3", "Supports": "",
                "Pressure": "left: 1.7, right: 1.7"}, {"Supports": "bottom: xy"}),
        Solved(energy(-1.7**2 * .91 / 2000 * .21)), ALL),
    Row("without a force, shifted out of an overlap",
        blocks({"Box corner": "0, .99", "Pressure": ""}, {"Supports": "bottom: xy"},
               {"Interference": "true"}), Solved(nothing_touches), quick=True),
    Row("nothing touches, displacements drive",
        blocks({"Pressure": "", "Displacement": "top: y = -.001"}, {"Supports": "bottom: xy"},
               {"Gap": ".002 + .001*sin(3*x)"}, {"Relative tolerance": 1e-8}, parts=8),
        Solved(nothing_touches), ALL, quick=True),
]

FEW = [
    Row("start set of one node, a face in the end", hump(20, 40, (24, 8)), dense=True),
    Row("start set empty: a gap to close first",
        blocks(contact={"Gap": ".01"}), Solved(even(top=BOTH + .01)), quick=True),
    Row("one active node of 320", hump(.7, 1e-6, (320, 2)),
        Solved(lambda result: [Figure("active", result.state["active_contacts"], 1., 0.)]),
        dense=True),
    Row("exactly weak: touches without a force",
        blocks({"Pressure": "", "Displacement": "top: y = -.01"}, contact={"Gap": ".01"}),
        Solved(lambda result: [Figure("energy", result.state["energy"], 0., 1e-12)])),
    Row("exactly weak on the unloaded half",
        blocks({"Pressure": "", "Supports": "left: x, top: y", "Box cells": "8, 4"},
               {"Box cells": "8, 4", "Supports": "bottom: xy"},
               {"Gap": "min(0, x - .5)*.01", "Interference": "true"},
               {"Relative tolerance": 1e-9}), dense=True, quick=True),
    Row("all active, solid", blocks(dim=3), Solved(even(top=sinks((1, 1), (1e3, 1e3), (.3, .3),
                                                                  dim=3))), ALL),
    Row("all active", blocks(), Solved(even(top=BOTH)), ALL, quick=True),
    Row("all active, degree 2", blocks(Element_degree=2), Solved(even(top=BOTH, bound=1e-4))),
    Row("all active, meshes that do not match",
        blocks({"Box cells": "5, 4"}), Solved(even(top=BOTH, bound=1e-4))),
    Row("all active, mortar, solid",
        blocks({"Box cells": "3, 4, 3"}, dim=3), Solved(even(bound=1e-4))),
    *(Row(f"gap of {gap:g} sizes of elements, closed", blocks(contact={"Gap": gap / 4}),
          Solved(even(top=BOTH + gap / 4))) for gap in (1e2, 1e6)),
    Row("gap of 1e6 sizes of elements, open",
        blocks({"Pressure": "", "Displacement": "top: y = -.001"}, contact={"Gap": 2.5e5}),
        Solved(nothing_touches)),
    *(Row(f"overlap of {overlap:g}", held(-overlap),
          Solved(even(squeezed(overlap), bound=1e-4))) for overlap in (1e-12, 1e-6, 1e-2, .5)),
    Row("overlap of .1, solid, mortar", held(-.1, 3, Method="mortar"),
        Solved(even(.1 / .002, bound=1e-4))),
    Row("overlap of .6 that nobody meant", held(-.6, Interference="false"),
        Refused(2, "overlap"), ONE),
]

PRESSED = {"Pressure": "top: 1", "Supports": "left: x"}
TILTED = {**FLOOR, "again": {"Normal": "1e-3, 1"}}
UP, LO = {"Box corner": ".2, 1"}, {"Supports": "bottom: xy"}

PLACES = [
    Row("the same plane twice", on_planes(PRESSED, {**FLOOR, "again": FLOOR["floor"]}, TWICE),
        Refused(3, "two contact rows the same"), quick=True),
    Row("the same plane twice, one 1e-3 deeper",
        on_planes(PRESSED, {**FLOOR, "again": {"Point": "0, -.001", "Normal": "0, 1"}}, TWICE),
        Refused(3, "two contact rows the same")),
    Row("planes that differ by 1e-3 of a turn",
        on_planes({**PRESSED, "Supports": "top: x"}, TILTED, TWICE), dense=True),
    Row("planes that a support makes the same", on_planes(PRESSED, TILTED, TWICE),
        Refused(3, "two contact rows the same")),
    Row("between three planes, with the corners in two of them",
        on_planes({"Pressure": "top: 1"},
                  {**FLOOR, "wall": {"Normal": "1, 0"},
                   "stop": {"Point": "1, 0", "Normal": "-1, 0"}},
                  "block.bottom: floor, block.left: wall, block.right: stop"),
        dense=True, methods=ALL),
    Row("both sides slaves of each other",
        blocks({**UP, "Supports": "left: x"}, LO,
               {"Pairs": "upper.bottom: lower.top, lower.top: upper.bottom"},
               {"Relative tolerance": 1e-9}),
        Refused(2, "upper.bottom"), ONE),
    Row("a master node of two slaves", two_punches(Slave="first"), dense=True, quick=True),
    Row("a slave face of two masters", two_punches(pairs=ABOVE, Slave="first"), dense=True),
    Row("a slave face of two masters, mortar",
        two_punches(pairs=ABOVE, Slave="first", Method="mortar"), dense=True),
    Row("slave nodes beyond the edge of the master",
        blocks({"Box corner": "-.37, 1", "Box size": "2, 1", "Box cells": "8, 4",
                "Supports": "top: x"}, LO, {"Slave": "first"}, {"Relative tolerance": 1e-9}),
        dense=True),
    Row("hanging slave nodes where the contact ends",
        hump(4, 5, (8, 6), upper={"Refine where": ".6 - x", "Local refinements": 2},
             contact={"Slave": "first"}), dense=True, quick=True),
    Row("a master corner over a refined slave",
        blocks({"Box corner": ".33, 1", "Supports": "right: x"},
               {**LO, "Box size": "2, 1", "Box cells": "8, 4", "Refine where": ".2 - abs(x - .33)",
                "Local refinements": 3},
               {"Pairs": "lower.top: upper.bottom", "Slave": "first"},
               {"Relative tolerance": 1e-9}), dense=True),
    Row("a punch narrower than a cell",
        blocks({"Box corner": ".4, 1", "Box size": ".1, .1", "Box cells": "2, 2",
                "Supports": "left: x"}, LO, solver={"Relative tolerance": 1e-9}), dense=True),
    Row("stands on a corner",
        on_planes({"Rotate": "z: 45", "Body force": "0 -1"}, FLOOR,
                  "block.bottom: floor, block.left: floor"), Solved(force(1)), dense=True),
    Row("stands on a corner of one face",
        on_planes({"Rotate": "z: 44.9", "Body force": "0 -1", "Supports": "top: x"}, FLOOR),
        dense=True),
    Row("stands on an edge, solid",
        on_planes({"Rotate": "y: -30", "Body force": "0 0 -1", "Supports": "left: xy"},
                  {"floor": {}}, contact={"Search distance": .01}, dim=3), dense=True),
    Row("lies on a line of a cylinder, solid",
        tight({"roll": {"Mesh": "cylinder", "Cells": "2, 2", "Rotate": "y: 90",
                        "Shift": "0, 0, 1", "Young's modulus": 1000, "Body force": "0 0 -1"}},
              "roll.outer: floor", {"Search distance": .05}, {"floor": {}}, 3), dense=True),
    Row("the rim of a tube on a sphere",
        tight({"tube": {"Mesh": "ring", "Cells": "16, 2, 2", "Young's modulus": 1000,
                        "Pressure": "top: 1"}}, "tube.bottom: ball", dim=3,
              obstacles={"ball": {"Shape": "sphere", "Radius": 1, "Point": "0, 0, -.87"}}),
        dense=True),
    Row("contact meets supports, which hold its ends",
        blocks({"Supports": "left: xy, right: x"}, {"Supports": "bottom: xy, left: xy"},
               solver={"Relative tolerance": 1e-9}), dense=True, methods=ALL),
    Row("supports hold all of the contact",
        blocks({"Supports": "bottom: xy"}, {"Supports": "top: xy"}), quick=True),
    Row("a stack of ten that tilted loads press",
        tight({f"b{i}": {"Box corner": f"0, {i}", "Box cells": "3, 3",
                         "Young's modulus": 1000 + 100 * i,
                         "Supports": "bottom: xy" if i == 0 else "left: x",
                         **({"Force": "top: .05 -1"} if i == 9 else {})} for i in range(10)},
              ", ".join(f"b{i}.bottom: b{i - 1}.top" for i in range(1, 10))), dense=True),
    Row("a long beam lifts off",
        scene({"beam": {"Box size": "40, 1", "Box cells": "320, 4", "Young's modulus": 1e5,
                        "Density": .01 / 9.81, "Supports": "left: x", "Force": "right: 0 .1"}},
              {"Pairs": "beam.bottom: floor"}, obstacles=FLOOR,
              sections={"Solver": {"Maximum F-mults": 4000}}, Dimension=2, Model="plane stress",
              Gravity="0 -9.81"), Solved(force(.3))),
]


def rough(coefficient, upper=None, lower=None, contact=None, **settings):
    """Return two blocks with friction, of which only the contact holds the upper one aside."""
    return blocks({"Supports": "", **(upper or {})}, {"Supports": "bottom: xy", **(lower or {})},
                  {"Friction": "Coulomb", "Friction coefficient": coefficient, **(contact or {})},
                  **settings)


def steps(cases, displacement, coefficient=.3, **settings):
    """Return two blocks with friction, the upper one with a round lower side, over load steps with
    these displacements of its top, formulas of i."""
    upper = {"Pressure": "", "Curved faces": "bottom: cylinder z 4", "Box cells": "8, 4",
             **settings.pop("upper", {})}
    return rough(coefficient, upper, {"Box cells": "8, 4", **settings.pop("lower", {})},
                 settings.pop("contact", {}),
                 sections={"Load case step": {"Cases": cases, "Load step": "true",
                                              "Displacement": displacement},
                           "Accuracy": {"Estimate": "none"}}, Load_cases="step", **settings)


def forces_of_steps(*wanted):
    """Return what is asked of the vertical contact force of each step, of which None is any."""
    def asked(result):
        forces = [case["state"]["contact_force"][1] for case in result.summary["load_cases"]]
        return [Figure(f"force of step {i}", abs(force), value, 1e-5)
                for i, (force, value) in enumerate(zip(forces, wanted)) if value is not None]
    return asked


def aside(value):
    """Return what is asked of the horizontal force on the upper block."""
    return lambda result: [Figure("force aside", abs(result.state["contact_force"][0]), value,
                                  1e-5)]


def of_tetrahedra(height, ratio=.3, **entries):
    """Return the row of a block of tetrahedra on a plane."""
    body = {"Mesh": "file", "File": "mesh.msh", "Young's modulus": 1000, "Poisson's ratio": ratio,
            "Supports": "left: x, front: y", "Pressure": "top: 1", **entries}
    return Row(f"tetrahedra of height {height:g}, Poisson's ratio {ratio:g}",
               tight({"block": body}, "block.bottom: floor", {}, {"floor": {}}, 3,
                     sections={"Solver": {}}),
               Solved(force(1, component=2)), SOLVERS if height > .01 and ratio < .4999 else ONE,
               mesh=lambda: tetrahedra(height))


BODIES = [
    *(of_tetrahedra(height) for height in (1, .1, .01)),
    *(of_tetrahedra(.1, ratio) for ratio in (.49, .4999)),
    Row("a slider that passes from one block to the next",
        tight({"slider": {"Box corner": "-.8, 1", "Box size": ".7, .3", "Box cells": "7, 3",
                          "Young's modulus": 1000, "Supports": "top: x", "Pressure": "top: 1"},
               **{name: {"Box corner": f"{x}, 0", "Box cells": "6, 4", "Young's modulus": 1000,
                         "Supports": "bottom: xy"} for name, x in (("one", -1), ("two", 0))}},
              "slider.bottom: one.top, slider.bottom: two.top",
              sections={"Load case move": {"Cases": 9, "Position": "slider: shift .113*(i+1) 0"}},
              Load_cases="move"), Solved(forces_of_steps(*[.7] * 9)), quick=True),
]

BACK = "upper.top: y = -.01, upper.top: x = .004*(2 - abs(i - 2))"
FRICTION = [
    Row("friction at 0.999 of its limit", rough(.3, {"Traction": "top: .2997 0"}),
        Solved(aside(.2997)), ONE, quick=True),
    Row("friction at 1.001 of its limit", rough(.3, {"Traction": "top: .3003 0"}),
        Refused(3, "no equilibrium: body upper is not held against its load"), ONE),
    Row("friction with SMALSE-M", rough(.3, {"Traction": "top: .1 0"}),
        Refused(2, "friction"), SOLVERS[1:]),
    *(Row(f"friction coefficient of {mu:g}", rough(mu, {"Traction": "top: .1 0"}),
          Solved(aside(.1)), ONE) for mu in (10, 1e3)),
    Row("friction coefficient of 1e-6, held aside",
        rough(1e-6, {"Displacement": "top: x = .01"}), Solved(aside(1e-6)), ONE),
    *(Row(f"friction, a modulus of {modulus:g} times",
          rough(.3, {"Traction": "top: .1 0", "Young's modulus": 1000 * modulus}, **LARGE),
          Solved(aside(.1)), ONE) for modulus in (1e-6, 1e6)),
    Row("friction, Poisson's ratio of 0.4999",
        rough(.3, {"Traction": "top: .1 0", "Poisson's ratio": .4999},
              {"Poisson's ratio": .4999}), Solved(aside(.1)), ONE),
    Row("friction, load steps that turn back", steps(5, BACK), Solved(), ONE, quick=True),
    Row("friction, load steps that turn back, mortar",
        steps(5, BACK, lower={"Box cells": "11, 4"}), Solved(), ONE),
    Row("friction, load steps that touch exactly in the third and part again",
        steps(5, "upper.top: y = -.00185*(2 - abs(i - 2)), upper.top: x = .001*i",
              upper={"Curved faces": ""}, contact={"Gap": ".0037"}),
        Solved(forces_of_steps(0., 0., 0., 0., 0.)), ONE),
    Row("exact touch in the third of six load cases",
        blocks({"Box corner": "0, 1.0111", "Pressure": ""}, lower={"Box cells": "3, 4"},
               sections={"Load case ramp": {
                   "Cases": 6, "Displacement": "upper.top: y = -.0037*(i + 1)"}},
               Load_cases="ramp"),
        Solved(forces_of_steps(0., 0., 0., None, None, None)), ONE, quick=True),
]

ROWS = [*FREE, *FEW, *PLACES, *BODIES, *FRICTION]
