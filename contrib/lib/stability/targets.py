"""Rows about meshes refined to a target."""

import math

from runs import run_once, section

from cases import Figure
from contacts import two_punches
from outcomes import ONE, Refused, Row, Solved, states_of
from scenes import blocks, nothing_touches

ROUND = {"Curved faces": "bottom: -(x^2)/(2*4)", "Pressure": "top: .125"}
# Faces of a sixth of the contact, of degree 2.
NEAR = {"Box cells": "16, 16", "Refine where": ".2 - x^2 - (y-1)^2", "Local refinements": 3}


def pressed(upper=None, lower=None, **settings):
    """Return a round block on a flat one, in contact on a fifth of a face."""
    return blocks({**ROUND, **(upper or {})}, lower, **settings)


def fine(upper=None, lower=None, **settings):
    """Return the same on the mesh of the truth."""
    return pressed({**NEAR, **(upper or {})}, {**NEAR, **(lower or {})}, Element_degree=2,
                   **settings)


def target(text, errors="potential energy: 1 %", **entries):
    return text + section("Accuracy", {"Target": errors, **{
        name.replace("_", " "): value for name, value in entries.items()}})


def met(result):
    return Figure("target met", float(result.summary["accuracy"]["met"]), 1., 0.)


NOT_SOLVED = Figure("what to compare with", math.nan, 1., 0.)


def value(state, name):
    if name == "force":
        return state["contact_force"][1]
    return state[name] if name in state else state["responses"][name]


def as_truth(truth, bound=1e-2, names=("energy",)):
    """Return what is asked: the values of a mesh of degree 2 that is not adapted, in all load
    cases."""
    def asked(result):
        right = run_once(truth).result
        if not right:
            return [NOT_SOLVED]
        return [met(result), *(
            Figure(name, value(found, name), value(of_truth, name), bound)
            for found, of_truth in zip(states_of(result), states_of(right)) for name in names)]
    return asked


def same_meshes(text):
    """Return what is asked: meshes as large as on one rank."""
    def asked(result):
        one = run_once(text).result
        if not one:
            return [NOT_SOLVED]
        of_one, found = ([mesh["dofs"] for mesh in of.summary["accuracy"]["meshes"]]
                         for of in (one, result))
        return [met(result), Figure("meshes of other sizes", float(of_one != found), 0., 0.)]
    return asked


def bump(cells=4, **near):
    """Return a bump narrower than a face and between its nodes, which alone would not touch."""
    body = {"Box cells": f"{cells}, {cells}", **near}
    return blocks({**body, "Pressure": "", "Supports": "left: x, top: x",
                   "Curved faces": "bottom: -.1 + .099*exp(-((x - .375)/.08)^2)",
                   "Displacement": "top: y = -.004"}, {**body, "Supports": "bottom: xy"},
                  Element_degree=2 if near else 1)


BUMP = target(bump())
AT_BUMP = {"Refine where": ".15 - sqrt((x - .375)^2 + (y - 1)^2)", "Local refinements": 4}
IDLE = blocks({"Pressure": "", "Curved faces": ROUND["Curved faces"]})
AS_WHOLE = blocks({"Pressure": "", "Supports": "left: x", "Displacement": "top: y = -.001"},
                  {"Supports": "bottom: xy"}, {"Gap": 10})
NO_LOAD = {"Pressure": ""}
OFF_AND_ON = {"Load_cases": "off, on", "sections": {
    "Load case off": {"Displacement": "upper.top: y = .01"},
    "Load case on": {"Displacement": "upper.top: y = -.0004"}}}
TWO_CASES = {"Load_cases": "light, heavy", "sections": {
    "Load case light": {"Pressure": "upper.top: .05"},
    "Load case heavy": {"Pressure": "upper.top: .4"}}}
CORNER = blocks({"Box size": ".5, 1"}, {"Box cells": "8, 4", "Supports": "bottom: xy"})
SOLID = {"dim": 3, "upper": {"Curved faces": "bottom: -(x^2+y^2)/(2*4)"}}
AT_POINT = {"Refine where": ".3 - sqrt(x^2 + y^2 + (z-1)^2)", "Local refinements": 2}


def held():
    """Return blocks with the displacement of a point that a support holds as response."""
    return blocks(ROUND, Responses="top, held", sections={"Response held": {
        "Quantity": "displacement", "Point": "0, .5", "Component": "x"}})


def over_corner(cells, lower=None, **settings):
    across = f"{cells}, {cells}"
    return blocks({"Box corner": ".33, 1", "Supports": "right: x", "Box cells": across},
                  {"Supports": "bottom: xy", "Box size": "2, 1",
                   "Box cells": f"{2 * cells}, {cells}", **(lower or {})},
                  {"Pairs": "lower.top: upper.bottom", "Slave": "first"}, **settings)


def narrow(upper=None, lower=None, **settings):
    """Return two wide blocks under an even pressure, with four cells along them."""
    wide = {"Box size": "2, 1", "Box cells": "4, 2"}
    return blocks({**wide, "Box corner": "-1, 1", "Supports": "left: x, right: x",
                   "Pressure": "top: 3", **(upper or {})},
                  {**wide, "Box corner": "-1, 0", "Supports": "left: x, right: x, bottom: y",
                   **(lower or {})}, **settings)


def last(name, right, bound):
    """Return what is asked of a response on the last mesh."""
    return lambda result: [met(result), Figure(
        name, result.summary["accuracy"]["meshes"][-1]["responses"][name]["value"], right, bound)]


# Data with a scale of 0.06 to 0.19 of a face of the first mesh. The force is that of the load;
# the others are those of meshes of degree 2 that are graded to a seventh of this scale.
NARROW = [
    Row("a narrow load",
        target(narrow({"Pressure": "top: 3 + 100*(abs(x - .186) < .025)"}), "contact force: 2 %"),
        Solved(last("contact force", 11., 4e-2)), ONE, quick=True),
    Row("a narrow gap",
        target(narrow(contact={"Method": "mortar", "Gap":
                               "-0.0013566*exp(-((x-(0.257715))^2)/0.00222474)"}, parts=1),
               "peak pressure: 2 %"),
        Solved(last("peak pressure", 8.08053, 4e-2)), ONE, quick=True),
    Row("a narrow curve of a face",
        target(narrow({"Curved faces":
                       "bottom: 0.000457783*exp(-((x-(0.480657))^2)/0.000212561)"},
                      contact={"Method": "nodal"}, parts=3), "peak pressure: 2 %"),
        Solved(last("peak pressure", 7.51748, 4e-2)), ONE, quick=True),
    Row("a narrow warp",
        target(narrow(lower={"Warp": "0; y^4*(-0.00107158*"
                                     "exp(-((x-(0.624041))^2)/0.00217587))"}, parts=3),
               "contact area: 5 %"),
        Solved(last("contact area", 1.91439, .1)), ONE, quick=True),
]

DOUBTFUL = [
    Row("contact on a fifth of a face", target(pressed()), Solved(as_truth(fine())), quick=True),
    Row("no node touches on the first mesh, a bump between its nodes does", BUMP,
        Solved(as_truth(bump(16, **AT_BUMP)))),
    Row("contact in one of two load cases: the other starts from nothing",
        target(pressed(NO_LOAD, **OFF_AND_ON), "contact force: 1 %"),
        Solved(as_truth(fine(NO_LOAD, **OFF_AND_ON), names=("force",))), ONE, quick=True),
    Row("without loads", target(IDLE), Solved(lambda result: [
        met(result), *nothing_touches(result)]), ONE, quick=True),
    Row("without loads, responses estimated",
        IDLE + section("Accuracy", {"Estimate": "responses"}), Solved(nothing_touches), ONE),
    Row("energy of a motion as a whole", target(AS_WHOLE),
        Refused(3, "it is probably zero; set its target as a number"), ONE),
    Row("energy of a motion as a whole, in its units",
        target(AS_WHOLE, "potential energy: 1e-9, top: .01 %"),
        Solved(lambda result: [met(result), *nothing_touches(result)]), ONE),
    Row("a load of 1e-12 is a load",
        target(pressed({"Pressure": "top: 1e-12"}), "peak pressure: 1 %", Maximum_unknowns=100),
        Refused(3, "a contact has fewer than 8 faces; the next mesh has"), ONE),
    Row("displacement where a support holds", target(held(), "held: 1 %"),
        Refused(3, "it is probably zero; set its target as a number"), ONE),
    Row("displacement where a support holds, in its units", target(held(), "held: 1e-8"),
        Solved(lambda result: [met(result), Figure("held", result.state["responses"]["held"], 0.,
                                                   1e-6)]), ONE),
    Row("peak pressure at a sharp corner", target(CORNER, "peak pressure: 1 %"),
        Refused(3, "it is probably unbounded"), ONE, quick=True),
    Row("too few levels", target(pressed(), "peak pressure: 1 %", Maximum_levels=3),
        Refused(3, "a contact has fewer than 8 faces; increase 'Maximum levels'"), ONE),
    Row("too few levels for the error", target(pressed(), "potential energy: .1 %",
                                             Maximum_levels=5),
        Refused(3, "; increase 'Maximum levels', or relax 'Target'"), ONE, quick=True),
    Row("too few unknowns", target(pressed(), Maximum_unknowns=500),
        Refused(3, "unknowns: increase 'Maximum unknowns', or relax 'Target'"), ONE),
]

MET = [
    Row("two load cases, two responses",
        target(pressed(NO_LOAD, **TWO_CASES), "potential energy: 1 %, top: 1 %"),
        Solved(as_truth(fine(NO_LOAD, **TWO_CASES), names=("energy", "top")))),
    Row("a displacement", target(pressed(), "top: .1 %"), Solved(as_truth(fine(), 1e-3, ("top",)))),
    Row("verified", target(pressed(), Verify="true"), Solved(as_truth(fine())), ONE),
    Row("degree 2", target(pressed(Element_degree=2)), Solved(as_truth(fine()))),
    Row("mortar", target(pressed(contact={"Method": "mortar"})), Solved(as_truth(fine()))),
    Row("mortar, meshes that do not match",
        target(pressed({"Box cells": "5, 4"}, contact={"Method": "mortar"})),
        Solved(as_truth(fine())), ONE),
    *(Row(f"axisymmetric, degree {degree}",
          target(pressed(Model="axisymmetric", Element_degree=degree)),
          Solved(as_truth(fine(Model="axisymmetric"))), ONE) for degree in (1, 2)),
    Row("solid", target(pressed(**SOLID), "potential energy: 3 %"),
        Solved(as_truth(pressed({**SOLID["upper"], **AT_POINT}, AT_POINT, dim=3,
                                parts=2, Element_degree=2), 3e-2)), ONE),
    Row("hanging slave nodes where the contact ends",
        target(pressed({"Box cells": "16, 16", "Refine where": ".048 - x",
                        "Local refinements": 2}, {"Box cells": "16, 16"},
                       contact={"Slave": "first"})), Solved(as_truth(fine()))),
    Row("a face opposite to two bodies",
        target(two_punches(Slave="first"), "potential energy: .2 %"),
        Solved(as_truth(two_punches(16, Slave="first"), 2e-3))),
    Row("a master corner over a refined slave",
        target(over_corner(4, {"Refine where": ".2 - abs(x - .33)", "Local refinements": 3}),
               "potential energy: 2 %"),
        Solved(as_truth(over_corner(48, Element_degree=2), 2e-2))),
    Row("one subdomain per cell of all meshes", target(pressed(parts=10**9)),
        Solved(as_truth(fine()))),
    *(Row(f"the meshes of one rank, {name}", text, Solved(same_meshes(text)), ONE)
      for name, text in (
          ("two load cases", target(pressed(NO_LOAD, **TWO_CASES), "peak pressure: 2 %")),
          ("bump", BUMP), ("solid", target(pressed(**SOLID), "peak pressure: 5 %")))),
]

ROWS = [*DOUBTFUL, *MET, *NARROW]
