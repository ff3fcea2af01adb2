"""Write scenes, run the program on them, read what a run leaves, and print tables.

All commands and studies of contrib/ run the program by this module. A scene is the path of a
parameter file or, with more than one line, its text. Entries change it: they are strings
'Subsection/Entry=value', or {'Subsection/Entry': value}."""

import atexit
import collections
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import types

ROOT = pathlib.Path(__file__).resolve().parents[2]
SECONDS = 300  # after which a run is stopped


class RunError(Exception):
    """This class tells that the program did not solve a scene."""


# Scenes.

def section(title, entries):
    """Return the text of a subsection."""
    return (f"subsection {title}\n" +
            "".join(f"  set {name} = {value}\n" for name, value in entries.items()) + "end\n")


def scene(bodies, contact, decomposition=None, obstacles=None, sections=None, **entries):
    """Return the text of a parameter file. Entries have underscores for blanks; bodies and
    obstacles are given by name, further sections by title."""
    obstacles = obstacles or {}
    given = {"Bodies": ", ".join(bodies),
             **({"Obstacles": ", ".join(obstacles)} if obstacles else {}), **entries}
    return "".join([
        *(f"set {name.replace('_', ' ')} = {value}\n" for name, value in given.items()),
        *(section(f"Body {name}", body) for name, body in bodies.items()),
        *(section(f"Obstacle {name}", obstacle) for name, obstacle in obstacles.items()),
        section("Contact", contact), section("Decomposition", decomposition or {}),
        *(section(*one) for one in (sections or {}).items())])


def changed(path, entries):
    """Return the text of a parameter file of the repository with these entries at its end,
    from which mesh files are found in any directory."""
    path = ROOT / path
    text = re.sub(r"(set File\s*=\s*)", rf"\1{path.parent}/", path.read_text(encoding="utf-8"))
    for name, value in entries.items():
        title, _, entry = name.rpartition("/")
        if title:
            text += section(title, {entry: value})
        else:  # an entry outside of subsections comes first
            text = f"set {entry} = {value}\n" + re.sub(rf"(?m)^set {entry} .*\n", "", text)
    return text


# Runs.

def once(function):
    """Return the function with a memory of its results, by all of its arguments."""
    known = {}

    def remembering(*arguments, **options):
        key = repr((arguments, options))
        if key not in known:
            known[key] = function(*arguments, **options)
        return known[key]
    return remembering


def read_csv(path):
    """Return the rows of a table, with numbers where a cell has one."""
    def number(cell):
        try:
            return float(cell)
        except ValueError:
            return cell
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: number(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def points_of(directory):
    """Return the contact points of the last state in a directory."""
    files = sorted(directory.glob("contact-*.csv"))
    return read_csv(files[-1]) if files else []


class Result:
    """This class has what one run leaves: its summary, the history of a search, and the contact
    points of the last state, with several load cases those of the first one and, in cases, of
    each by its name. The picture is the file of the fields of the first body of a sensitivity of
    one load case. share is the part of a core that the run had."""

    def __init__(self, directory, share=1.):
        self.share = share
        self.summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        self.state = self.summary.get("state")
        history = directory / "history.csv"
        self.history = read_csv(history) if history.exists() else []
        self.picture = ""
        for picture in directory.glob("solution-0000/00-*.0000.vtu"):
            if self.summary.get("task") == "sensitivity":
                self.picture = picture.read_text(encoding="utf-8")
        self.cases = {case["name"]: points_of(directory / case["name"])
                      for case in self.summary.get("load_cases", [])}
        self.points = next(iter(self.cases.values())) if self.cases else points_of(directory)

    def pressures(self, pair=None):
        """Return the pressures at the contact points, of one pair if given."""
        return [p["pressure"] for p in self.points if pair is None or p["pair"] == pair]

    def mean_pressure(self, pair=None):
        """Return the contact force over its area, of one pair if given."""
        points = [p for p in self.points if pair is None or p["pair"] == pair]
        return math.fsum(p["force"] for p in points) / math.fsum(p["area"] for p in points)

    def half_width(self, expected, radius, first=0., last=.8):
        """Return where the straight line through p^2 over r^2 is zero, for first < r / expected
        < last and the radius(point) r; nan if it has no zero or less than two points."""
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

    def on_processor(self, *parts):
        """Return the CPU seconds of parts of the run, without the program's start."""
        return self.share * sum(self.summary["times"][part] for part in parts)


# status: that of the program, below zero that of a signal; message: its line of error; result:
# None if the run failed; output: standard output; seconds, cpu: of the clock and the
# processor; megabytes: the maximum memory of one process.
Run = collections.namedtuple("Run", "status message result output seconds cpu megabytes",
                             defaults=["", 0., 0., 0.])


def environment():
    """Return the environment with one thread per rank, as contrib/run sets it."""
    lines = (ROOT / "contrib/lib/run.env").read_text(encoding="utf-8").splitlines()
    return {**dict(line.split("=", 1) for line in lines), **os.environ}


def built(variable, path):
    """Return the program that a variable of the environment names, or that of build/."""
    return os.environ.get(variable, str(ROOT / "build" / path))


def parallel(ranks, *options):
    """Return the words of a command that start so many ranks."""
    return ["mpirun", "-np", str(ranks), *options] if ranks > 1 else []


def command(scene_file, entries, output, ranks=1, program=None, launcher=()):
    """Return the words of the command that runs the program on a file."""
    settings = ([f"{name}={value}" for name, value in entries.items()]
                if isinstance(entries, dict) else entries)
    return [*parallel(ranks, *launcher), str(program or built("SNUG", "snug")), str(scene_file),
            "--output", str(output), *(word for one in settings for word in ("--set", one))]


def execute(words, timeout=SECONDS, **options):
    """Return (status, standard output, standard error, seconds, usage) of a command."""
    start = time.monotonic()
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=output, stderr=errors,
                              env=environment(), **options) as process:
            timer = threading.Timer(timeout, process.kill)
            timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        output.seek(0)
        errors.seek(0)
        return process.returncode, output.read(), errors.read(), seconds, usage


@once
def common_start(program):
    """Return a start of stability.many, in which runs are children that need no start."""
    started = subprocess.Popen([program, str(SECONDS), "8000"], stdin=subprocess.PIPE, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                               env=environment())
    atexit.register(started.communicate)
    return started


def execute_in_common(words):
    """Return what execute() does, of a run of the program on one rank. If SNUG_MANY names
    stability.many, it is in one start of this with others: it has neither output nor memory, nor
    the start in its times."""
    if "SNUG_MANY" not in os.environ:
        return execute(words)
    started, start = common_start(os.environ["SNUG_MANY"]), time.monotonic()
    print("\t".join(words[1:]), file=started.stdin, flush=True)
    status, cpu, _, message = started.stdout.readline().rstrip("\n").split("\t", 3)
    usage = types.SimpleNamespace(ru_utime=float(cpu), ru_stime=0., ru_maxrss=math.nan)
    return int(status), "", message, time.monotonic() - start, usage


def run(scene_file, entries=(), ranks=1, *, mesh=None, options=(), program=None, launcher=(),
        timeout=SECONDS, accepted=(0,), inspect=Result, alone=False):
    """Return the Run of a scene. mesh: the bytes of mesh.msh beside it; options: further words
    of the command, launcher those of mpirun; accepted: the statuses of runs that leave a
    result, None for all, which inspect(directory, share) reads; alone: whether the run must not
    be in a common start."""
    in_common = not (alone or program or launcher) and ranks == 1
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        path = ROOT / scene_file if "\n" not in str(scene_file) else directory / "scene.prm"
        if path.parent == directory:
            path.write_text(scene_file, encoding="utf-8")
        if mesh:
            (directory / "mesh.msh").write_bytes(mesh)
        output = directory / "output"
        words = command(path, entries, output, ranks, program, launcher) + list(options)
        status, said, errors, seconds, usage = (
            execute_in_common(words) if in_common else execute(words, timeout))
        cpu = usage.ru_utime + usage.ru_stime
        message = next((line for line in errors.splitlines() if line.startswith("snug: ")),
                       f"stopped after {timeout} s" if seconds > timeout else "")
        left = ((accepted is None or status in accepted) and
                (output / "summary.json").exists())
        return Run(status, message, inspect(output, cpu / seconds) if left else None, said,
                   seconds, cpu, usage.ru_maxrss / 1024)


run_once = once(run)


@once
def solve(scene_file, entries=(), ranks=1, **options):
    """Return the Result of a scene; throw RunError if the program fails. Options are those of run()."""
    done = run(scene_file, entries, ranks, **options)
    if done.result is None:
        raise RunError(f"{scene_file}: status {done.status}, {done.message}")
    return done.result


# Tables and arguments.

def print_row(*columns):
    """Print a row of a table in markdown at once."""
    print("| " + " | ".join(map(str, columns)) + " |", flush=True)


def print_head(*columns):
    """Print the head of a table in markdown."""
    print_row(*columns)
    print("|" + "---|" * len(columns), flush=True)


def print_table(rows):
    """Print dictionaries with equal keys as a table, numbers with three digits."""
    print_head(*rows[0])
    for row in rows:
        print_row(*(f"{value:.3g}" if isinstance(value, float) else value
                    for value in row.values()))


def write_csv(path, rows):
    """Write dictionaries with equal keys as a table, and print its path."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.9g}" if isinstance(value, float) else value
                          for key, value in row.items()} for row in rows)
    print(path)


def sample(cases):
    """Return a list of the cases, or one of every SNUG_SAMPLE of them if this variable of the
    environment is set, as in tests that run for every change."""
    return list(cases)[::int(os.environ.get("SNUG_SAMPLE", "1"))]


def quick_and_words(document, allowed):
    """Return whether the arguments have --quick, and the other words; print the document and
    exit if one of these is not allowed(word)."""
    words = [word for word in sys.argv[1:] if word != "--quick"]
    if not all(map(allowed, words)):
        print(document.strip())
        sys.exit(0 if words in (["-h"], ["--help"]) else 2)
    return len(words) < len(sys.argv) - 1, words


def range_of(words, first, last):
    """Return the numbers FIRST to LAST that words give, a single one, or those by default."""
    ends = [int(word) for word in words] or [first, last]
    return range(ends[0], ends[-1] + 1)
