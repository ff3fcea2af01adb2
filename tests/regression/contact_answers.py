#!/usr/bin/env python3
"""Signs of forces, reactions at edges, friction where supports hold both sides, and nodes beyond the search distance: contact_answers.py,
with the program that SNUG names."""

import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from expectations import Expectations  # noqa: E402
from runs import scene, solve  # noqa: E402


def force(quantity, component, **entries):
    """Return the entries of a response."""
    return {"Quantity": quantity, "Component": component, **entries}


def pushed(upper, lower):
    """Return a block with so many cells that is pressed down by 0.01 and moved to the right."""
    return scene(
        {"up": {"Box corner": "0, 1", "Box cells": f"{upper}, 3", "Young's modulus": 1000,
                "Displacement": "top: y = -0.01, top: x = 0.004"},
         "lo": {"Box corner": "-0.5, 0", "Box size": "2, 1", "Box cells": f"{lower}, 3",
                "Young's modulus": 1000, "Supports": "bottom: xy"}},
        {"Pairs": "up.bottom: lo.top", "Friction": "Coulomb", "Friction coefficient": 0.1},
        sections={"Response fx": force("contact force", "x"),
                  "Response fy": force("contact force", "y"),
                  "Response ff": force("friction force", "x"),
                  "Response fm": force("friction moment", "z", Point="0, 0.9"),
                  "Accuracy": {"Estimate": "none"}},
        Dimension=2, Responses="fx, fy, ff, fm")


def pulled_edges():
    """Return a block that is held at the top and its left side and pressed on its free side."""
    return scene(
        {"block": {"Box cells": "4, 4, 4", "Young's modulus": 1000, "Supports": "left: x",
                   "Displacement": "top: z = -0.01, top: y = 0.002*x, bottom: z = 0",
                   "Pressure": "right: 3"}}, {},
        sections={f"Response {name}": force("reaction", component, Face=f"block.{face}")
                  for name, component, face in (("top", "z", "top"), ("bottom", "z", "bottom"),
                                                ("left", "x", "left"), ("free", "z", "right"),
                                                ("beside", "x", "top"))},
        Dimension=3, Responses="top, bottom, left, free, beside")


def round_on_plane(distance):
    """Return a round side that is pressed on a block, whose contact is wider than its nodes within
    the search distance if this is small."""
    return scene(
        {"up": {"Box corner": "-0.5, 1", "Box cells": "12, 3", "Young's modulus": 1000,
                "Curved faces": "bottom: cylinder z 2",
                "Displacement": "top: y = -0.01, top: x = 0"},
         "lo": {"Box corner": "-1, 0", "Box size": "2, 1", "Box cells": "24, 6",
                "Young's modulus": 1000, "Supports": "bottom: xy"}},
        {"Pairs": "up.bottom: lo.top", "Search distance": distance}, Dimension=2)


FRICTION = {"Friction": "Coulomb", "Friction coefficient": 0.1}


def press_fit(cells):
    """Return a ring pressed into another and pushed along the axis in load steps, there and back.
    Supports hold both sides of the contact at one end."""
    steps = {"Load step": "true", "Cases": 4,
             "Displacement": "inner.bottom: y = -0.004*min(i+1, 3-i)"}
    around = {"Box cells": f"4, {cells}", "Young's modulus": 210000}
    return scene(
        {"inner": {**around, "Box corner": "10, 0", "Box size": "10.0025, 20"},
         "outer": {**around, "Box corner": "20, 0", "Box size": "10, 20",
                   "Supports": "bottom: y"}},
        {"Pairs": "inner.right: outer.left", "Interference": "true", **FRICTION},
        sections={"Load case fit": {"Displacement": "inner.bottom: y = 0"},
                  "Load case push": steps, "Response n": {"Quantity": "contact force"},
                  "Response r": force("reaction", "y", Face="inner.bottom"),
                  "Response t": force("friction force", "y"),
                  "Accuracy": {"Estimate": "none"}},
        Dimension=2, Model="axisymmetric", Load_cases="fit, push", Responses="n, r, t")


def dragged(gap):
    """Return a solid block that slides on another, held along the way at one side of both."""
    up = "top: z = -0.01, top: y = 0.1, top: x = 0, left: y = 0.1"
    return scene(
        {"up": {"Box corner": "0, 0, 1", "Box cells": "3, 3, 3", "Young's modulus": 1000,
                "Displacement": up},
         "lo": {"Box cells": "3, 3, 3", "Young's modulus": 1000,
                "Supports": "bottom: xyz, left: y"}},
        {"Pairs": "up.bottom: lo.top", "Gap": gap, **FRICTION},
        sections={"Response n": {"Quantity": "contact force"},
                  "Response t": force("friction force", "y"), "Response up": {
                      "Quantity": "reaction", "Component": "y", "Face": "up.top"},
                  "Response side": force("reaction", "y", Face="up.left"),
                  "Accuracy": {"Estimate": "none"}},
        Dimension=3, Responses="n, t, up, side")


def main():
    expect = Expectations()
    # The finer side is the slave: the side named first, then the other one.
    first, second = (solve(pushed(*cells)).state["responses"] for cells in ((6, 8), (4, 12)))
    for name, value in first.items():
        expect(f"{name}: {value} with one slave, {second[name]} with the other one",
               abs(value - second[name]) < 0.05 * abs(value))
    expect("the upper block is pushed up and held back", first["fy"] > 0. > first["ff"])
    values = solve(pulled_edges()).state["responses"]
    print(values)
    expect("a free face has no reaction", values["free"] == 0.)
    expect("a face has no reaction along axes that it does not hold", values["beside"] == 0.)
    expect("reactions balance the pressure", abs(values["left"] - 3.) < 1e-9)
    expect("reactions balance each other", abs(values["top"] + values["bottom"]) < 1e-9)
    for cells in (8, 16):
        cases = solve(press_fit(cells)).summary["load_cases"]
        for case, sign in zip(cases[1:], (-1, -1, 1, 1)):
            values = case["state"]["responses"]
            expect(f"press fit of {cells} cells pushed by {sign}: {values}",
                   abs(values["r"] - sign * 0.1 * values["n"]) < 1e-5 * values["n"] and
                   abs(values["r"] + values["t"]) < 1e-5 * values["n"])
    for gap in ("0", "-0.002"):
        values = solve(dragged(gap)).state["responses"]
        expect(f"all nodes of a dragged block slide: {values}",
               abs(abs(values["t"]) - 0.1 * values["n"]) < 1e-3 * values["n"])
        expect("reactions balance the friction",
               abs(values["t"] + values["up"] + values["side"]) < 1e-6 * values["n"])
    for distance, warns in ((0.001, True), (0.1, False)):
        warnings = solve(round_on_plane(distance)).summary["warnings"]
        expect(f"search distance {distance}: {warnings}",
               any("beyond the search distance" in line for line in warnings) == warns)
    return expect.status()


if __name__ == "__main__":
    sys.exit(main())
