"""Runs of the program and what they say about gradients."""

import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]


class RunError(Exception):
    """The program did not solve a scene."""


def environment():
    """As contrib/run sets it: one thread per rank."""
    entries = os.environ.copy()
    for line in (ROOT / "contrib/lib/run.env").read_text().splitlines():
        name, _, value = line.partition("=")
        entries.setdefault(name, value)
    return entries


def run(scene, settings, points=False):
    """summary.json of a scene with {"Subsection/Entry": value} set, or the contact
    points of its first state."""
    program = os.environ.get("SNUG", str(ROOT / "build" / "snug"))
    with tempfile.TemporaryDirectory() as directory:
        result = subprocess.run(
            [program, str(ROOT / scene), f"--output={directory}",
             *(f"--set={name}={value}" for name, value in settings.items())],
            env=environment(), capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise RunError(result.stderr.strip())
        if not points:
            path = pathlib.Path(directory) / "summary.json"
            return json.loads(path.read_text())
        path = pathlib.Path(directory) / "contact-0000.csv"
        with open(path, newline="") as file:
            return [{key: float(value) for key, value in row.items()}
                    for row in csv.DictReader(file)]


def gradient(scene, settings, method, **options):
    """The summary's gradient of the objective by one method; options are entries of
    subsection Gradient with underscores for blanks."""
    entries = {"Task": "sensitivity", "Gradient/Compare": "false",
               "Gradient/Method": method, **settings}
    for name, value in options.items():
        entries["Gradient/" + name.replace("_", " ")] = value
    return run(scene, entries)


def compared(scene, settings, **options):
    """{method: row} of all methods side by side."""
    entries = {"Task": "sensitivity", "Gradient/Compare": "true", **settings}
    for name, value in options.items():
        entries["Gradient/" + name.replace("_", " ")] = value
    rows = run(scene, entries)["gradient"]["methods"]
    return {row["method"]: row for row in rows}


def error(values, reference):
    """|values - reference| / |reference|"""
    return math.dist(values, reference) / math.hypot(*reference)


def write_csv(path, rows):
    """Rows are dictionaries with equal keys."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{value:.9g}" if isinstance(value, float)
                             else value for key, value in row.items()})
    print(path)
