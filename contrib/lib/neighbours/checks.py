"""How errors on curved faces fall on finer and on uneven meshes: one line per check."""

import math
import sys

from cases import error, run
from gears import gears
from rollers import cylinders, rollers, solid_spheres, spheres
from round_bodies import pins, rings, shells
import uneven

NODES = ("least p", "largest p")


def measured(case):
    """The figures of a case by name; empty if its run failed or has no mesh."""
    mesh = case.mesh() if case.mesh else None
    if case.mesh and not mesh:
        return {}
    result = run(case.text, case.ranks, mesh).result
    return {figure.name: figure for figure in case.asked(result)} if result else {}


def line(good, text):
    print(("ok      " if good else "FAILED  ") + text, flush=True)
    return good


def hold(*cases):
    """Every figure of the cases is within its bound."""
    good = True
    for case in cases:
        figures = measured(case)
        if not figures:
            good = line(False, f"{case.family} {case.setting}: no result")
        for figure in figures.values():
            good &= line(error(figure) <= figure.bound,
                         f"{case.family} {case.setting}: {figure.name} {figure.found:.6g}, "
                         f"right {figure.right:.6g}, error {error(figure):.2e}, at most "
                         f"{figure.bound:.2e}")
    return good


def fall(cases, names, least_order, ratio=2.):
    """The worst error of these figures from mesh to mesh, each finer by the ratio."""
    errors = [max([error(found[name]) for name in names] if found else [math.inf])
              for found in map(measured, cases)]
    orders = [math.log(a / b, ratio) for a, b in zip(errors, errors[1:])]
    title = "mean" if names == ("mean p",) else "nodes"
    return line(min(orders) >= least_order,
                f"{cases[0].family} {cases[0].setting} and finer: {title} " +
                ", ".join(f"{value:.2e}" for value in errors) + "; orders " +
                ", ".join(f"{value:.2f}" for value in orders) + f", at least {least_order}")


QUARTERS = [rings(15 * 2**i, 12 * 2**i, "quarter", method="mortar") for i in range(4)]
FULL = [rings(60 * 2**i, 48 * 2**i, method="mortar") for i in range(4)]
OCTANTS = [shells(5 * 2**i, 4 * 2**i, method="mortar", layers=(4 * 2**i, 4 * 2**i))
           for i in range(3)]
UNEVEN = [uneven.rings(60 * 2**i, 48 * 2**i, .1) for i in range(4)]

CHECKS = {
    "rings": lambda: all([hold(*QUARTERS, *FULL),
                          *(fall(series, ("mean p",), 1.7) for series in (QUARTERS, FULL)),
                          *(fall(series, NODES, .8) for series in (QUARTERS, FULL))]),
    "shells": lambda: all([hold(*OCTANTS), fall(OCTANTS, ("mean p",), 1.7),
                           fall(OCTANTS, NODES, .8)]),
    "uneven": lambda: all([hold(*UNEVEN), fall(UNEVEN, NODES, 0.),
                           hold(uneven.rings(100, 84, .1, ranks=2),
                                uneven.pins(100, 124), uneven.pins(124, 100, ranks=3),
                                uneven.pins(96, 96))]),
    "nodal": lambda: hold(rings(60, 48, method="nodal"),
                          rings(15, 12, "quarter", method="nodal"),
                          rings(120, 96, "quarter", method="nodal"),
                          shells(10, 8, method="nodal")),
    "pins": lambda: hold(pins(48, 60, method="mortar"), pins(48, 60),
                         pins(384, 480, method="mortar"), pins(96, 96, "full")),
    "cylinders": lambda: hold(
        *(rollers(cylinders, model=model, **mesh)
          for model in ("plane strain", "plane stress")
          for mesh in ({}, {"cells": (4, 5)}, {"levels": (6, 6)})),
        rollers(spheres, cells=(4, 5), levels=(4, 4)), rollers(solid_spheres, cells=(4, 5))),
    "gears": lambda: hold(gears(order=1), gears(order=1, refinements=1),
                          gears(order=1, degree=2), gears(), gears(degree=2)),
    "free": lambda: hold(*(rings(n, m, subdomains=parts, ranks=ranks, method=method)
                           for n, m, parts, ranks, method in (
                               (48, 60, 1, 1, None), (95, 96, 5, 2, None),
                               (100, 84, 12, 3, None), (60, 61, 30, 4, None),
                               (48, 48, 7, 2, None), (90, 96, 2, 1, "nodal"))),
                         *(pins(n, m, "full", subdomains=parts, ranks=ranks)
                           for n, m, parts, ranks in (
                               (96, 96, 1, 1), (72, 96, 3, 2), (96, 95, 16, 3),
                               (64, 64, 30, 4)))),
}


def main(names):
    """0 if the named checks, or all, hold."""
    if any(name not in CHECKS for name in names):
        print("checks: " + ", ".join(CHECKS), file=sys.stderr)
        return 2
    return 0 if all([CHECKS[name]() for name in names or CHECKS]) else 1
