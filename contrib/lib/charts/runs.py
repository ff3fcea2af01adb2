"""Runs of the program, what they leave and what they cost."""

import contextlib
import csv
import json
import math
import pathlib
import resource
import subprocess
import tempfile
import time

import gallery_runs

ROOT = pathlib.Path(__file__).resolve().parents[3]


class RunError(Exception):
    """The program did not solve a scene."""


@contextlib.contextmanager
def finished(scene, settings, ranks=1):
    """The directory of a run of a scene with {"Subsection/Entry": value} set, and its CPU
    seconds over those of the clock, which also tells what else the machine does."""
    with tempfile.TemporaryDirectory() as directory:
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        process = gallery_runs.launch(
            ROOT / scene, [f"{name}={value}" for name, value in settings.items()], directory,
            ranks, stderr=subprocess.PIPE, text=True)
        passed = time.monotonic() - start
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if process.returncode != 0:
            raise RunError(process.stderr.strip())
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        yield pathlib.Path(directory), used / passed


def table(path):
    with open(path, newline="") as file:
        return [{key: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def run(scene, settings, points=False, ranks=1):
    """summary.json of a scene with its share of the processor as "share", or the contact
    points of its first state."""
    with finished(scene, settings, ranks) as (directory, share):
        if not points:
            return {**json.loads((directory / "summary.json").read_text()), "share": share}
        return table(directory / "contact-0000.csv")


def result(scene, settings):
    """The gallery's Result of a state, with its CPU seconds without the program's start."""
    with finished(scene, settings) as (directory, share):
        found = gallery_runs.Result(directory)
        found.seconds = share * found.summary["times"]["total"]
        return found


def history(scene, settings):
    """Rows of history.csv, and the summary with its share of the processor."""
    with finished(scene, settings) as (directory, share):
        return table(directory / "history.csv"), {
            **json.loads((directory / "summary.json").read_text()), "share": share}


def on_processor(found, *parts):
    """CPU seconds of parts of the run, without the program's start."""
    return found["share"] * sum(found["times"][part] for part in parts)


def gradient(scene, settings, method, ranks=1, **options):
    """The summary's gradient of the objective by one method; options are entries of
    subsection Gradient with underscores for blanks."""
    entries = {"Task": "sensitivity", "Gradient/Compare": "false",
               "Gradient/Method": method, **settings}
    for name, value in options.items():
        entries["Gradient/" + name.replace("_", " ")] = value
    return run(scene, entries, ranks=ranks)


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


def print_table(rows):
    """In markdown, numbers with three digits: what the pages quote."""
    print("| " + " | ".join(rows[0]) + " |\n" + "|---" * len(rows[0]) + "|")
    for row in rows:
        print("| " + " | ".join(f"{value:.3g}" if isinstance(value, float) else str(value)
                                for value in row.values()) + " |")
