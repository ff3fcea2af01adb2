#!/usr/bin/env python3
"""What twenty states cost, in counts: work.py SNUG TABLE.

Every row of the table is a scene, with entries of its own where it has some, and what
the solver spends on its state from a cold start and on the linear solve beside it. Counts
do not depend on the machine but by rounding: one that is more than 2 and more than a tenth
off, in either direction, is an error, so that a gain is written down as well as a loss.
"""

import argparse
import csv
import json
import pathlib
import shlex
import sys
import tempfile

import compare

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "contrib/lib"))

from runs import execute_in_common  # noqa: E402

ENTRIES = ["Task=state", "Accuracy/Target=", "Solver/Report linear reference=true"]
GIVEN = ("scene", "entries")
LEAST = 2


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def counts(summary):
    """Of all that the run did, and of its linear solve."""
    return {"linear_f_mults": summary["state"]["linear_f_mults"], **summary["work"]}


def run(program, row, directory):
    """(counts, what went wrong)"""
    command = [program, str(ROOT / row["scene"]), "--output", str(directory)]
    for entry in ENTRIES + list(filter(None, row["entries"].split("; "))):
        command += ["--set", entry]
    status, _, said, *_ = execute_in_common(command)
    if status:
        return {}, f"status {status}: {said.strip()}"
    return counts(json.loads((directory / "summary.json").read_text(encoding="utf-8"))), None


def differences(row, found):
    """Messages on counts of a row; what the run counts and the table lacks is one."""
    for key in {**{key: None for key in row if key not in GIVEN}, **found}:
        wanted = row.get(key)
        text = (f"{found.get(key)} is not in the table" if wanted in (None, "") else
                compare.count_difference(found.get(key), float(wanted), LEAST))
        if text is not None:
            yield f"{row['scene']} {row['entries']}: {key}: {text}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("--accept", action="store_true",
                        help="write what the runs count into the table")
    options = parser.parse_args()
    rows, messages = read(options.table), []
    with tempfile.TemporaryDirectory() as name:
        for number, row in enumerate(rows):
            found, wrong = run(options.program, row, pathlib.Path(name, str(number)))
            messages += [f"{row['scene']}: {wrong}"] if wrong else differences(row, found)
            if options.accept and wrong:
                sys.exit(messages[-1])
            rows[number] = {**{key: row[key] for key in GIVEN}, **found}
    if options.accept:
        write(options.table, rows)
        return 0
    print("\n".join(messages) or f"{len(rows)} scenes as in {options.table}")
    if messages:
        print("accept with: " + shlex.join([sys.argv[0], "--accept", options.program,
                                            str(options.table)]))
    return 1 if messages or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
