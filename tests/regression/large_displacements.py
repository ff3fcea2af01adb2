#!/usr/bin/env python3
"""What large displacements would change: large_displacements.py, with the program that SNUG names.

The number printed for a body is compared with closed forms: the strain of a bar, the linear term of
the load of a disc spring (Almen and Laszlo, Trans. ASME 58, 1936), zero for bending. A rotation that
supports leave free does not count. Results beyond the bound end with status 3, unless accepted."""

import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from expectations import Expectations  # noqa: E402
from runs import run, scene  # noqa: E402

NONE = {"Accuracy": {"Estimate": "none"}}
ACCEPT = "Accept large displacements=true"


def body(entries, dim=2, **more):
    return scene({"part": {"Young's modulus": 1000, **entries}}, {}, sections=NONE,
                 Dimension=dim, **more)


def bar(strain):
    """Return a bar that is pulled, free to become thinner."""
    return body({"Box size": "2, 1", "Box cells": "4, 2", "Supports": "left: x, bottom: y",
                 "Displacement": f"right: x = {2 * strain}"})


def cantilever(deflection):
    """Return a slender beam that is bent at its end."""
    return body({"Box size": "10, 1", "Box cells": "40, 4", "Supports": "left: xy",
                 "Force": f"right: 0 {deflection * 1000 / (4 * 10**3) / .91}"})


def leaning(side):
    """Return a stiff block on springs, of which the right ones are softer; only springs hold it."""
    return body({"Box size": f"{side}, {side}", "Box cells": "4, 4", "Young's modulus": 1e6,
                 "Force": "top: 0 -1",
                 "Springs": "bottom: y = 40/(1 + 2*x), bottom: x = 1000"})


def disc(travel, height=1.4):
    """Return a disc spring between rigid planes, a cone of 12.3 x 1.5."""
    planes = {"upper": {"Point": f"0, {1.5 + height}", "Normal": "0, -1",
                        "Displacement": f"0, {-travel}"}, "lower": {"Normal": "0, 1"}}
    cone = {"Box corner": "12.7, 0", "Box size": "12.3, 1.5", "Box cells": "40, 6",
            "Warp": f"0; {height}*(25 - x)/12.3", "Young's modulus": 206000}
    return scene({"disc": cone}, {"Pairs": "disc.top: upper, disc.bottom: lower"},
                 obstacles=planes, sections=NONE, Dimension=2, Model="axisymmetric")


def almen_laszlo(travel, height=1.4, thickness=1.5):
    """Return the linear term of the load over its constant one, per load and travel: the load is
    s ((h - s) (h - s/2) t + t^3), s the travel."""
    return -1.5 * height * travel * thickness / (height**2 * thickness + thickness**3)


def hertz():
    """Return a metal cylinder on a rigid plane, under a high pressure."""
    return scene({"part": {"Box cells": "24, 24", "Curved faces": "bottom: cylinder z 4",
                           "Young's modulus": 210000, "Supports": "left: x",
                           "Pressure": "top: 100"}},
                 {"Pairs": "part.bottom: floor"}, obstacles={"floor": {"Normal": "0, 1"}},
                 sections=NONE, Dimension=2)


def effect(text, accepted=False):
    """Return the status, the effect and the rigid rotation of the only body."""
    done = run(text, [ACCEPT] if accepted else [], accepted=(0, 3))
    of_body = done.result.state["assumptions"]["bodies"][0]
    return done.status, of_body["large_displacements"], of_body["rigid_rotation"], done.message


def main():
    expect = Expectations()
    for strain in (.01, -.05):
        _, found, _, _ = effect(bar(strain))
        expect(f"bar pulled by {strain}: {found}", math.isclose(found, 1.5 * strain, rel_tol=1e-6))
    _, found, rotation, _ = effect(cantilever(.3))
    expect(f"cantilever bent by .03 of its length: {found}", abs(found) < .002 and rotation == 0.)
    _, found, rotation, _ = effect(leaning(1))
    expect(f"leaning block: {found}, rotation {rotation}", abs(found) < 1e-4 < .005 < rotation)
    for travel in (.05, .2):
        _, found, _, _ = effect(disc(travel))
        expect(f"disc spring pressed by {travel}: {found}, {almen_laszlo(travel)} by Almen and "
               "Laszlo", math.isclose(found, almen_laszlo(travel), rel_tol=.05))
    _, found, _, _ = effect(hertz())
    expect(f"cylinder of steel: {found}", abs(found) < .005)
    status, found, _, message = effect(disc(1.05))
    expect(f"disc spring pressed by 1.05: {found}, status {status}, {message}",
           status == 3 and "the result is not valid" in message)
    status, _, _, _ = effect(disc(1.05), accepted=True)
    expect(f"accepted: status {status}", status == 0)
    return expect.status()


if __name__ == "__main__":
    sys.exit(main())
