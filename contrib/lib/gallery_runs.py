"""Runs of scenes for contrib/gallery, and what they leave."""

import csv
import functools
import json
import math
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Result:
    """What one run leaves: its summary and its contact points, at the end; with
    several load cases those of the first. The picture is the fields of a sensitivity."""

    def __init__(self, directory):
        self.summary = json.loads((directory / "summary.json").read_text())
        self.state = self.summary["state"]
        self.picture = ""
        if self.summary["task"] == "sensitivity":
            self.picture = (directory / "solution-0000.0000.vtu").read_text()
        for case in self.summary.get("load_cases", [])[:1]:
            directory /= case["name"]
        with open(max(directory.glob("contact-*.csv")), newline="") as file:
            self.points = [{key: float(value) for key, value in row.items()}
                           for row in csv.DictReader(file)]

    def pressures(self, pair=None):
        return [p["pressure"] for p in self.points
                if pair is None or p["pair"] == pair]

    def half_width(self, expected, radius, first=0., last=.8):
        """Where the straight line through p^2 over r^2 is zero, first < r /
        expected < last; radius: a point's r. nan if it has no zero or less than two
        points."""
        squares = [(radius(p)**2, p["pressure"]**2) for p in self.points
                   if first < radius(p) / expected < last]
        n = len(squares)
        if n < 2:
            return math.nan
        mean_x, mean_y = (sum(s[i] for s in squares) / n for i in (0, 1))
        slope = (sum((x - mean_x) * (y - mean_y) for x, y in squares) /
                 sum((x - mean_x)**2 for x, _ in squares))
        square = mean_x - mean_y / slope
        return math.sqrt(square) if square >= 0. else math.nan


def environment():
    """As contrib/run sets it: one thread per rank."""
    entries = os.environ.copy()
    for line in (ROOT / "contrib/lib/run.env").read_text().splitlines():
        name, _, value = line.partition("=")
        entries.setdefault(name, value)
    return entries


def command(scene, settings, output, ranks=1):
    program = os.environ.get("SNUG", str(ROOT / "build" / "snug"))
    parallel = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    return [*parallel, program, str(scene), f"--output={output}",
            *(f"--set={setting}" for setting in settings)]


def launch(scene, settings, output, ranks=1, **options):
    """The process of one run that has ended; options are those of subprocess.run."""
    return subprocess.run(command(scene, settings, output, ranks),
                          stdout=subprocess.DEVNULL, env=environment(), **options)


@functools.lru_cache(maxsize=None)
def solve(scene, *settings):
    """The Result of a scene, a path from the root, with these entries."""
    with tempfile.TemporaryDirectory() as directory:
        launch(ROOT / scene, settings, directory, check=True)
        return Result(pathlib.Path(directory))
