"""Rows about numbers: contrast, units, tolerances, slender bodies, subdomains."""

from runs import scene

from outcomes import ALL, ONE, SOLVERS, Refused, Row, Solved, SolvedOrRefused
from scenes import blocks, even, hump, sinks, untorn

POWERS = (-9, -6, -3, 3, 6, 9)
ENDS = (-12, -6, 6, 12)


# 1e-14 is 45 epsilon.
DIGITS = ((1e-12, Solved()), (1e-14, SolvedOrRefused(3, "allow")))


def hump_to(tolerance):
    return hump(4, 20, (8, 6), solver={"Relative tolerance": tolerance})


def between(power, **entries):
    return blocks({"Young's modulus": 10.**power * 1000}, **entries)


def inside(power, region, solver=None, **body):
    """Return a lower block of two materials, without strain across."""
    return blocks({"Poisson's ratio": 0}, {"Materials": "core: core, body: rest",
                                           "Young's modulus": "", "Region formulas": region,
                                           **body},
                  Materials="core, rest", solver=solver,
                  sections={"Material core": {"Young's modulus": 10.**power * 1000,
                                              "Poisson's ratio": 0},
                            "Material rest": {"Young's modulus": 1000, "Poisson's ratio": 0}}
                  ).replace("  set Young's modulus = \n", "")


def stiff_hump(power):
    return hump(4, 20, (8, 6), upper={"Young's modulus": 10.**power * 1000})


def layers(power):
    """Return the row of a block whose upper half is of another material."""
    return Row(f"contrast 1e{power} inside a body, layers", inside(power, "core: y - .5"),
               Solved(even(top=1e-3 + .5e-3 * (1 + 10.**-power))))


CONTRAST = [
    *(Row(f"contrast 1e{power} between bodies", between(power),
          Solved(even(top=sinks((1, 1), (10.**power * 1000, 1000), (.3, .3)))),
          ALL if abs(power) == 9 else SOLVERS, quick=power == 9)
      for power in POWERS),
    *(Row(f"contrast 1e{power} between bodies, solid", between(power, dim=3),
          Solved(even(top=sinks((1, 1), (10.**power * 1000, 1000), (.3, .3), dim=3))))
      for power in (-9, 9)),
    *(Row(f"contrast 1e{power} between bodies, round", stiff_hump(power), dense=True)
      for power in (-6, -3, 3)),
    # beyond what dense algebra tells
    *(Row(f"contrast 1e{power} between bodies, round", stiff_hump(power),
          Solved(untorn(stiff_hump(power)))) for power in (-9, 6, 9)),
    *map(layers, POWERS),
    *(Row(f"contrast 1e{power} inside a body, a stiff or soft core",
          inside(power, "core: .1 - (x - .5)^2 - (y - .5)^2", {"Relative tolerance": 1e-8},
                 **{"Box cells": "8, 8"}), dense=True) for power in (-6, -3, 3, 6)),
]

RATIOS = [
    *(Row(f"Poisson's ratio {nu}", blocks({"Poisson's ratio": nu}, {"Poisson's ratio": nu}),
          Solved(even(top=sinks((1, 1), (1e3, 1e3), (nu, nu)), bound=1e-4)),
          quick=nu == .4999) for nu in (-.9, -.5, 0, .45, .49, .4999)),
    Row("Poisson's ratio .4999, B-bar, round",
        hump(4, 20, (8, 6), upper={"Poisson's ratio": .4999, "Formulation": "B-bar"},
             lower={"Poisson's ratio": .4999, "Formulation": "B-bar"}), dense=True),
    Row("Poisson's ratio .4999, B-bar, solid",
        blocks({"Poisson's ratio": .4999, "Formulation": "B-bar"},
               {"Poisson's ratio": .4999, "Formulation": "B-bar"}, dim=3),
        Solved(even(top=.002, bound=1e-4)), ALL),
    Row("Poisson's ratio -.9, round",
        hump(4, 20, (8, 6), upper={"Poisson's ratio": -.9}), dense=True),
]


def scaled(load, modulus, length=1.):
    """Return the blocks in other units; displacements are as length load / modulus."""
    size = {"Box size": f"{length!r}, {length!r}"}
    top = length * load / modulus * sinks((1, 1), (1, 1), (.3, .3))
    return (blocks({**size, "Box corner": f"0, {length!r}", "Young's modulus": modulus,
                    "Pressure": f"top: {load!r}"}, {**size, "Young's modulus": modulus}),
            Solved(even(load, top)))


UNITS = [
    *(Row(f"modulus and load in units of 1e{power}", *scaled(10.**power, 1e3 * 10.**power))
      for power in ENDS),
    *(Row(f"load 1e{power}", *scaled(10.**power, 1e3), quick=power == -12) for power in ENDS),
    *(Row(f"lengths in units of 1e{power}", *scaled(1., 1e3, 10.**power))
      for power in (-9, -6, 6, 9)),
    # which leaves this much of the energy to the subdomains
    Row("tolerance 0.1", hump_to(.1), Solved(untorn(hump_to(1e-6), 1e-2, ("energy",)))),
    *(Row(f"tolerance {tolerance:g}", hump_to(tolerance), end,
          methods=ALL if tolerance == 1e-14 else SOLVERS, dense=True)
      for tolerance, end in DIGITS),
    *(Row(f"tolerance {tolerance:g}, solid",
          blocks({"Curved faces": "bottom: sphere 4", "Pressure": "top: 20"}, dim=3,
                 solver={"Relative tolerance": tolerance}), end, dense=True)
      for tolerance, end in DIGITS),
    Row("tolerance 1e-15", blocks(solver={"Relative tolerance": 1e-15}),
        Refused(2, "between 1e-14 and 0.1"), ONE, quick=True),
]


def wide(aspect, parts):
    """Return blocks of so many times their height."""
    size = {"Box size": f"{aspect}, 1", "Box cells": f"{4 * min(aspect, 25)}, 4"}
    return blocks(size, size, parts=parts)


def column(length, parts):
    """Return a column on a floor of its width."""
    return blocks({"Box size": f"1, {length}", "Box cells": f"1, {length}"},
                  {"Box cells": "1, 1"}, parts=parts)


def lying(length, parts):
    """Return a beam on another, both of so many times two squares."""
    size = {"Box size": f"{length}, 1", "Box cells": f"{length}, 2"}
    return blocks(size, size, parts=parts, solver={"Relative tolerance": 1e-8})


SIZES = [
    *(Row(f"subdomains of aspect {aspect}", wide(aspect, 2), Solved(even(bound=1e-4)))
      for aspect in (1, 10, 100)),
    *(Row(f"column of {length} cells in {parts} subdomains", column(length, parts),
          Solved(even(top=sinks((length, 1), (1e3, 1e3), (.3, .3)), bound=1e-4)),
          ALL if length == 100 else SOLVERS, quick=length <= 200)
      for length, parts in ((100, 100), (200, 2), (1000, "auto"), (1000, 10), (1000, 1001))),
    *(Row(f"beam of {length} cells on its side in {parts} subdomains", lying(length, parts),
          Solved(even(bound=1e-4))) for length, parts in ((100, 20), (1000, 20), (1000, 200))),
    *(Row(f"cells of aspect {aspect:g}",
          blocks({"Box size": f"1, {1 / aspect}"}, {"Box size": f"{1}, 1"}),
          Solved(even(bound=1e-4))) for aspect in (1e2, 1e4)),
    Row("cells of aspect 1e6: bending stiffness is beyond double precision",
        blocks({"Box size": "1, 1e-6"}),
        Refused(3, "the stiffness of subdomain 0 of body upper is not positive definite")),
    *(Row(f"cells graded to 1:{grading:g}",
          blocks({"Box grading": f"1, {grading}", "Box cells": "4, 12"},
                 {"Box grading": f"{grading}, 1", "Box cells": "12, 4"}, {"Slave": "first"}),
          Solved(even(top=sinks((1, 1), (1e3, 1e3), (.3, .3)), bound=1e-4)))
      for grading in (1e2, 1e4)),
    *(Row(f"slivers, sheared by {shear:g}",
          blocks({"Warp": f"{shear}*sin(3.14159265358979*(y-1))*sin(3.14159265358979*x); 0",
                  "Box cells": "6, 6"}),
          Solved(even(bound=1e-4))) for shear in (.3, .31)),
]

TEARING = [
    *(Row(f"{parts} subdomains", blocks(parts=parts),
          Solved(even(top=sinks((1, 1), (1e3, 1e3), (.3, .3)))), ALL, quick=parts == 32)
      for parts in (2, 32)),
    Row("1e9 subdomains wanted", blocks(parts=10**9), Solved(even(bound=1e-4)), quick=True),
    Row("one subdomain per body, round", hump(4, 20, (8, 6), parts=2), dense=True),
    Row("one subdomain per cell, round", hump(4, 20, (8, 6), parts=96), dense=True),
    Row("one subdomain per cell, solid", blocks(parts=128, dim=3),
        Solved(even(bound=1e-4)), ALL),
    Row("one subdomain per cell, METIS",
        blocks(parts=32).replace("Subdomains = 32\n", "Subdomains = 32\n  set Method = METIS\n"),
        Solved(even(bound=1e-4))),
    *(Row(f"one subdomain per cell, hanging nodes{more}", text,
          Solved(lambda result, text=text: [*even(bound=1e-4)(result),
                                            *untorn(text, 1e-7, ("energy",))(result)]))
      for more, text in (
          ("", blocks({"Refine where": ".6 - x", "Local refinements": 2},
                      {"Refine where": ".6 - x", "Local refinements": 1}, parts=110)),
          (", solid", blocks({"Refine where": ".6 - x", "Local refinements": 1,
                              "Box cells": "2, 2, 2"}, {"Box cells": "3, 3, 3"}, parts=80,
                             dim=3)))),
    Row("two cells in all", blocks({"Box cells": "1, 1"}, {"Box cells": "1, 1"}),
        Solved(even(top=sinks((1, 1), (1e3, 1e3), (.3, .3)))), ALL),
    Row("two cells in all, solid",
        blocks({"Box cells": "1, 1, 1"}, {"Box cells": "1, 1, 1"}, dim=3),
        Solved(even()), quick=True),
    Row("one cell across: fixing nodes on a line",
        blocks({"Box size": ".01, .01, 1", "Box cells": "1, 1, 20"},
               {"Box size": ".01, .01, 1", "Box cells": "1, 1, 20"}, parts=40, dim=3),
        Solved(even(bound=1e-4))),
    Row("a stiff block on a nearly incompressible one",
        scene({"punch": {"Box corner": "1, 1.5, 2.5", "Box cells": "5, 5, 5",
                         "Young's modulus": 1000, "Poisson's ratio": 0,
                         "Displacement": "top: x = 0, top: y = 0, top: z = -.7142857"},
               "base": {"Box size": "9, 4, 2.5", "Box cells": "24, 12, 6",
                        "Young's modulus": 1, "Poisson's ratio": .499,
                        "Formulation": "B-bar", "Supports": "bottom: xyz"}},
              {"Pairs": "punch.bottom: base.top", "Method": "mortar"}, Dimension=3),
        methods=ONE),
]

ROWS = [*CONTRAST, *RATIOS, *UNITS, *SIZES, *TEARING]
