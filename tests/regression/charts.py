#!/usr/bin/env python3
"""The charts, small: charts.py CHART SNUG.

Every chart leaves its table and its picture, and the tables say what the pages claim:
exact derivatives of a slender body are exact, refined differences do not mind its
slenderness, and at a weakly active contact the quadratic program gives the derivatives
of both sides, which the strong set alone does not; the Dirichlet preconditioner takes
fewer F-mults than the lumped one, and that than none, and warm starts fewer than cold ones,
or about as many next to rounding; refined meshes are nearer to the truth with fewer unknowns;
adjoint derivatives cost fewer F-mults than direct ones, and those fewer than differences;
with friction a state costs at most 2.2 times one without, and a gradient 0.6 of the state.
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def slender_errors(directory, derivatives):
    return [float(row["error"])
            for row in read(directory / "gradient-slender.csv")
            if row["derivatives"] == derivatives]


CHARTS = {"gradient": ("steps", "slender", "tolerances", "weak"), "solvers": ("",), "friction": ("",),
          "precision": ("line", "peers"), "design": ("variables", "searches")}


def f_mults(directory, chart, solver, place=-1):
    """Of the last value, or that of another place."""
    return [float(row["F-mults"]) for row in read(directory / "solvers.csv")
            if (row["chart"], row["solver"]) == (chart, solver)][place]


def claims_of_cost(directory):
    """Of precision and design, as below."""
    refined, even = ([row for row in read(directory / "precision-line.csv")
                      if (row["quantity"], row["series"]) == ("energy", series)]
                     for series in ("adapted, degree 1", "uniform, degree 1"))
    for name in ("unknowns", "error"):
        yield f"refined, {name}", float(refined[-1][name]) < float(even[0][name])
    works = {row["method"]: float(row["F-mults"])
             for row in read(directory / "design-variables.csv")}
    yield "work of gradients", (works["energy"] < works["adjoint"] < works["direct, block"] <
                                works["overall, forward"])


def claims(directory):
    """(what, whether it holds)"""
    for chart in ("tolerance", "H/h", "subdomains"):
        active, lumped, none = (f_mults(directory, chart, solver) for solver in (
            "active set", "lumped", "no preconditioner"))
        yield f"preconditioners, {chart}", active < lumped < none / 1.5
    yield "warm starts", (f_mults(directory, "tolerance", "active set, warm") <
                          f_mults(directory, "tolerance", "active set"))
    yield "warm starts to rounding", (
        f_mults(directory, "tolerance", "active set, warm", 0) <
        1.5 * f_mults(directory, "tolerance", "active set", 0))
    counts = {row["curve"]: float(row["F-mults"])
              for row in read(directory / "friction.csv") if row["chart"] == "2D: subdomains"}
    yield "work with friction", (counts["gradient"] < 0.6 * counts["state"] and
                                 counts["next load step"] < counts["state"] <
                                 2.2 * counts["state without friction"])
    forward = slender_errors(directory, "forward")
    refined = slender_errors(directory, "refined forward")
    sides = read(directory / "gradient-weak.csv")

    def apart(one, other):
        """Largest difference over the variables, relative to the largest value."""
        return max(abs(float(row[one]) - float(row[other]))
                   for row in sides) / max(abs(float(row[one]))
                                           for row in sides)

    yield from claims_of_cost(directory)
    yield "exact", max(slender_errors(directory, "exact")) < 1e-9
    yield "differences mind slenderness", forward[-1] > 8. * forward[0]
    yield "refined ones do not", max(refined) < 3. * min(refined)
    for side in ("up", "down"):
        yield f"QP {side}", apart(f"QP, {side}", f"differences, {side}") < 1e-5
    yield "strong set", max(apart("QP, up", "strong set"),
                            apart("QP, down", "strong set")) > 1e-2


def main(chart, program):
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        for family, charts in CHARTS.items():
            subprocess.run([chart, family, "--quick", "--output", name,
                            *filter(None, charts)],
                           env={**os.environ, "SNUG": program,
                                "PYTHONDONTWRITEBYTECODE": "1"}, check=True)
        wrong = [f"{what}: not so" for what, holds in claims(directory)
                 if not holds]
        files = ["-".join(filter(None, (family, path))) for family, charts in CHARTS.items()
                 for path in charts]
        wrong += [f"{file}.{kind}: missing" for file in files for kind in ("csv", "png")
                  if not (directory / f"{file}.{kind}").is_file()]
    print("\n".join(wrong) or "all as claimed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
