#!/usr/bin/env python3
"""The benchmarks of whole runs on small scenes: bench.py BENCHMARKS SNUG.

Each prints one row per case and program, of which the first has two, with all of its columns filled
in."""

import csv
import pathlib
import subprocess
import sys
import tempfile

# columns that a row must have above zero, and the number of cases
EXPECTED = {"whole": (["seconds", "cpu", "MB", "setup", "solve"], 2),
            "hard": (["linear_f_mults", "f_mults"], 4),
            "ranks": (["f_mults", "MB_solve"], 6),
            "gradient": (["cold_states"], 8),
            "optimization": (["evaluations", "f_mults"], 8)}


def is_fitted(scaling, ranks):
    """The cost model of many ranks finds the powers and the gain of a team that a table of the coarse
    problem was made of."""
    with tempfile.TemporaryDirectory() as directory:
        paths = [pathlib.Path(directory) / name for name in ("ranks.csv", "coarse.csv")]
        paths[0].write_text(ranks)
        paths[1].write_text("ranks,subdomains,factorization,solve,MB\n" + "".join(
            f"{ranks},{n},{wall * 1e-8 * n ** 2},{wall * 1e-7 * n ** 1.25},{1e-3 * n ** 1.5 / ranks}\n"
            for ranks, wall in ((1, 1.), (4, 1.5)) for n in (100, 1000, 5000)))
        done = subprocess.run([sys.executable, scaling, *paths], text=True, check=False,
                              capture_output=True)
    right = "factorization 2.00, solve 1.25, memory 1.50" in done.stdout and \
        "team of 4: factorization 0.75 of one rank's, solve 0.75, memory 0.25" in done.stdout and \
        sum(line.startswith("| 1e+0") for line in done.stdout.splitlines()) == 6
    print("scaling", "right" if right else "wrong: " + done.stdout + done.stderr)
    return right


def main(benchmarks, snug):
    wrong = 0
    for name, (columns, n_cases) in EXPECTED.items():
        against = ["--against", snug] if name == "whole" else []
        done = subprocess.run([sys.executable, benchmarks, snug, name, "--quick", *against],
                              text=True, check=False, stdout=subprocess.PIPE)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        failure_reasons = [f"column {column}" for column in columns
                      if not all(row.get(column) and float(row[column]) > 0. for row in rows)]
        n_rows = 2 * n_cases if against else n_cases
        if len(rows) != n_rows:
            failure_reasons.append(f"{len(rows)} rows, not {n_rows}")
        if done.returncode != 0:
            failure_reasons.append(f"status {done.returncode}")
        wrong += bool(failure_reasons)
        print(name, "wrong: " + ", ".join(failure_reasons) if failure_reasons else "right")
        if name == "ranks":
            wrong += not is_fitted(pathlib.Path(benchmarks).with_name("scaling.py"), done.stdout)
    done = subprocess.run([sys.executable, benchmarks, "/bin/false", "whole", "--quick"],
                          text=True, check=False, capture_output=True)
    if done.returncode != 1 or len(done.stderr.strip().splitlines()) != 1:
        print("a program that fails is not one line:", done.stderr)
        wrong += 1
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
