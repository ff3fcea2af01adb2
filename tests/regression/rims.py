#!/usr/bin/env python3
"""Pressures that no mesh offset changes: rims.py, with the program that SNUG names.

A narrow block moves over the faces of a wide one by less than one face. The side that ends inside
the other one is the slave, so that the largest pressure and its measures follow the offset by a few
percent, and by no jump. The edge is sharp, so that the exact pressure is unbounded there."""

import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from expectations import Expectations  # noqa: E402
from runs import sample, scene, solve  # noqa: E402


def block(x, dim, contact, cells=(23, 40)):
    """Return a block at x on a wider one of twice its modulus."""
    size, corner, narrow, wide, planes, last = {
        2: ("1, .5", f"{x}, 1", f"{cells[0]}, 12", f"{cells[1]}, 20", "left: x", "xy"),
        3: ("1, .6, .5", f"{x}, .31, 1", "7, 4, 4", "12, 12, 6", "left: x, front: y", "xyz")}[dim]
    return scene(
        {"top": {"Box corner": corner, "Box size": size, "Box cells": narrow,
                 "Young's modulus": 1000, "Supports": planes, "Pressure": "top: 10"},
         "base": {"Box size": "2, 1" if dim == 2 else "2, 2, 1", "Box cells": wide,
                  "Young's modulus": 2000, "Supports": f"bottom: {last}"}},
        contact, sections={"Accuracy": {"Estimate": "none"},
                           "Response p": {"Quantity": "peak pressure"}},
        Dimension=dim, Responses="p")


def scan(dim, contact, face, n, cells=(23, 40)):
    """Return the largest pressures and the measures at n offsets of one face."""
    states = [solve(block(.3 + face * i / n, dim, contact, cells)).state for i in range(n + 1)]
    return {"largest": [state["max_pressure"] for state in states],
            "measure": [state["responses"]["p"] for state in states]}


def main():
    expect = Expectations()
    pairs, exchanged = "top.bottom: base.top", "base.top: top.bottom"
    # Pairs in both orders; mortar, and nodal rows where a node of the narrow side has one row.
    cases = [(2, {"Pairs": pairs}, .05), (2, {"Pairs": exchanged}, .05),
             (2, {"Pairs": pairs, "Method": "nodal"}, .05), (3, {"Pairs": pairs}, 2 / 12)]
    for dim, contact, face in sample(cases):
        n = 20 if dim == 2 else 6
        for name, values in scan(dim, contact, face, n).items():
            mean = sum(values) / len(values)
            spread = max(abs(value / mean - 1.) for value in values)
            jump = max(abs(b - a) for a, b in zip(values, values[1:])) / mean
            right = spread < .1 and (dim == 3 or name == "largest" or jump < .02)
            expect(f"{dim}D, {contact}, {name}: mean {mean:.4g}, within {100 * spread:.1f} %, steps "
                   f"up to {100 * jump:.1f} %", right)
    return expect.status()


if __name__ == "__main__":
    sys.exit(main())
