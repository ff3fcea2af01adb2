#!/usr/bin/env python3
"""The benchmarks of whole runs on small scenes: bench.py BENCHMARKS SNUG.

Each prints one row per case and program with all of its columns filled in."""

import csv
import subprocess
import sys

# columns that a row must have above zero, and the number of cases
EXPECTED = {"whole": (["seconds", "cpu", "MB", "setup", "solve"], 2),
            "hard": (["linear_f_mults", "f_mults"], 4),
            "ranks": (["f_mults", "MB_solve"], 6),
            "gradient": (["cold_states"], 8),
            "optimization": (["evaluations", "f_mults"], 2)}


def main(benchmarks, snug):
    wrong = 0
    for name, (columns, n_cases) in EXPECTED.items():
        done = subprocess.run([sys.executable, benchmarks, snug, name, "--quick",
                               "--against", snug], text=True, check=False,
                              stdout=subprocess.PIPE)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        complaints = [f"column {column}" for column in columns
                      if not all(row.get(column) and float(row[column]) > 0. for row in rows)]
        if len(rows) != 2 * n_cases:
            complaints.append(f"{len(rows)} rows, not {2 * n_cases}")
        if done.returncode != 0:
            complaints.append(f"status {done.returncode}")
        wrong += bool(complaints)
        print(name, "wrong: " + ", ".join(complaints) if complaints else "right")
    done = subprocess.run([sys.executable, benchmarks, "/bin/false", "whole", "--quick"],
                          text=True, check=False, capture_output=True)
    if done.returncode != 1 or len(done.stderr.strip().splitlines()) != 1:
        print("a program that fails is not one line:", done.stderr)
        wrong += 1
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
