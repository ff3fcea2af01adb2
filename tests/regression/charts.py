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

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "contrib/lib"))

from runs import sample  # noqa: E402


def slender(rows):
    def errors(derivatives):
        return [float(row["error"]) for row in rows if row["derivatives"] == derivatives]

    forward, refined = errors("forward"), errors("refined forward")
    yield "exact", max(errors("exact")) < 1e-9
    yield "differences mind slenderness", forward[-1] > 8. * forward[0]
    yield "refined ones do not", max(refined) < 3. * min(refined)


def weak(rows):
    def apart(one, other):
        """Return the largest difference over the variables, relative to the largest value."""
        return (max(abs(float(row[one]) - float(row[other])) for row in rows) /
                max(abs(float(row[one])) for row in rows))

    for side in ("up", "down"):
        yield f"QP {side}", apart(f"QP, {side}", f"differences, {side}") < 1e-5
    yield "strong set", max(apart("QP, up", "strong set"),
                            apart("QP, down", "strong set")) > 1e-2


def solvers(rows):
    def f_mults(chart, solver, place=-1):
        """Return the F-mults of the last value, or of that at another place."""
        return [float(row["F-mults"]) for row in rows
                if (row["chart"], row["solver"]) == (chart, solver)][place]

    for chart in ("tolerance", "H/h", "subdomains"):
        active, lumped, none = (f_mults(chart, solver) for solver in (
            "active set", "lumped", "no preconditioner"))
        yield f"preconditioners, {chart}", active < lumped < none / 1.5
    yield "warm starts", (f_mults("tolerance", "active set, warm") <
                          f_mults("tolerance", "active set"))
    yield "warm starts to rounding", (f_mults("tolerance", "active set, warm", 0) <
                                      1.5 * f_mults("tolerance", "active set", 0))


def friction(rows):
    counts = {row["curve"]: float(row["F-mults"])
              for row in rows if row["chart"] == "2D: subdomains"}
    yield "work with friction", (counts["gradient"] < 0.6 * counts["state"] and
                                 counts["next load step"] < counts["state"] <
                                 2.2 * counts["state without friction"])


def line(rows):
    refined, even = ([row for row in rows
                      if (row["quantity"], row["series"]) == ("energy", series)]
                     for series in ("adapted, degree 1", "uniform, degree 1"))
    for name in ("unknowns", "error"):
        yield f"refined, {name}", float(refined[-1][name]) < float(even[0][name])


def variables(rows):
    works = {row["method"]: float(row["F-mults"]) for row in rows}
    yield "work of gradients", (works["energy"] < works["adjoint"] < works["direct, block"] <
                                works["overall, forward"])


def some_rows(rows):
    yield "rows", len(rows) > 0


# family, chart, and what its table must say
CHARTS = [("gradient", "slender", slender), ("gradient", "steps", some_rows),
          ("design", "searches", some_rows), ("gradient", "weak", weak),
          ("gradient", "tolerances", some_rows), ("precision", "peers", some_rows),
          ("solvers", "", solvers), ("precision", "line", line),
          ("design", "variables", variables), ("friction", "", friction)]


def main(command, program):
    wrong = []
    for family, chart, claims in sample(CHARTS):
        name = "-".join(filter(None, (family, chart)))
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([command, family, "--quick", "--output", folder,
                            *filter(None, [chart])],
                           env={**os.environ, "SNUG": program, "PYTHONDONTWRITEBYTECODE": "1"},
                           check=True)
            paths = [pathlib.Path(folder) / f"{name}.{kind}" for kind in ("csv", "png")]
            wrong += [f"{path.name}: missing" for path in paths if not path.is_file()]
            if paths[0].is_file():
                with open(paths[0], newline="", encoding="utf-8") as file:
                    rows = list(csv.DictReader(file))
                wrong += [f"{name}, {what}: not so" for what, holds in claims(rows) if not holds]
    print("\n".join(wrong) or "all as claimed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
