#!/usr/bin/env python3
"""Time whole runs of snug and print a table (CSV): medians of interleaved repeats.

usage: benchmarks.py SNUG NAME [--against PROGRAM [--unknown SECTION]] [--repeats N] [--quick]
                     [SIZE]...

NAME  whole         process time and memory from file to files; SIZE: cells per edge of the
                    two bodies of prm/hertz-3d-9.prm, 20 and 32 if not given; then graded
                    as well, so that no two subdomains are congruent
      hard          scenes that need many F-mults: linear, cold, and what they cost
      ranks         the same work on 1, 2 ... SIZE ranks (2 if not given), and as much more,
                    also with mortar rows on faces that do not match
      gradient      1, 4, 9 and 16 variables, direct and adjoint, in cold states; SIZE as whole
      optimization  the searches of all scenes that have one, without estimates of the mesh
                    error, and with bounds 0.2, 5 and 100 times as wide

--against PROGRAM runs another snug beside it, turn by turn; its rows follow. It is not given
entries that begin with SECTION, of which it does not know.
--quick takes small sizes and one repeat, to see that all works."""

import argparse
import collections
import csv
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]

# entries: of the parameter file; columns: of a summary and what the process took
Case = collections.namedtuple("Case", "name scene entries ranks", defaults=[1])

# what a rank sends in a stage, as count_messages.c has it
NOTHING_SENT = dict.fromkeys(["messages", "message_bytes", "collectives", "collective_bytes"], 0)

TORN = ["Task=state", "Accuracy/Estimate=none"]
STAGES = ["setup", "assembly", "factorization", "soft_modes", "solve", "gradient", "output"]


class RunError(Exception):
    """One line that says which run failed."""


def cubes(n, *entries):
    """Both bodies of the paper's scene with n cells per edge."""
    return [f"Body {body}/Box cells={n}, {n}, {n}" for body in ("punch", "foundation")] + [
        *entries]


def hertz(name, variables=9, entries=(), ranks=1):
    return Case(name, f"prm/hertz-3d-{variables}.prm", list(entries), ranks)


def whole_cases(sizes, quick):
    graded = [f"Body {body}/Box grading=2, 3, {ratio}"
              for body, ratio in (("punch", 4), ("foundation", 0.25))]
    cases = []
    for n in sizes or ([4] if quick else [20, 32]):
        cases += [hertz(f"boxes {n}", 9, TORN + cubes(n)),
                  hertz(f"graded {n}", 9, TORN + cubes(n, *graded))]
    return cases


def hard_cases(_sizes, quick):
    linear = [*TORN, "Solver/Report linear reference=true"]
    n = 4 if quick else 20
    scenes = [("graded plane", "prm/hertz-2d.prm", []), ("gear", "prm/gear-pair.prm", []),
              ("round, METIS", "prm/gmsh-pin.prm", []), ("hip", "prm/hip-joint.prm", []),
              ("axisymmetric", "prm/point-contact-axisymmetric.prm", []),
              ("degree 2", "prm/nafems-roller.prm", []), ("chain", "prm/leaf-spring.prm", []),
              ("point", "prm/point-contact.prm", []),
              ("boxes", "prm/hertz-3d-9.prm", cubes(n)),
              ("boxes, METIS", "prm/hertz-3d-9.prm", cubes(n, "Decomposition/Method=METIS")),
              ("nu 0.499, B-bar", "prm/hertz-3d-9.prm",
               cubes(n, *(f"Body {body}/{entry}" for body in ("punch", "foundation")
                          for entry in ("Poisson's ratio=0.499", "Formulation=B-bar"))))]
    return [Case(name, scene, linear + entries) for name, scene, entries in
            (scenes[:1] + scenes[8:] if quick else scenes)]


def ranks_cases(sizes, quick):
    n, counts = (6 if quick else 24), [2 ** k for k in range(1 + max(sizes or [2]).bit_length())]
    counts = [ranks for ranks in counts if ranks <= max(sizes or [2])]
    cases = [hertz("same work", 9, TORN + cubes(n), ranks) for ranks in counts]
    for name, other, entries in (("more work", n // 2, []),
                                 ("more work, mortar", n // 2 - 2, ["Contact/Method=mortar"])):
        for ranks in counts:
            # as many as ranks of them, as near to a square as powers of two allow
            across = 2 ** (ranks.bit_length() // 2)
            along = ranks // across
            grown = [f"Body {body}/Box {entry}"
                     for body, corner, m in (("punch", 1, n // 2), ("foundation", 0, other))
                     for entry in (f"cells={m * across}, {m * along}, {m}",
                                   f"size={across}, {along}, 1", f"corner=0, 0, {corner}")]
            cases.append(hertz(name, 9, TORN + grown + entries, ranks))
    return cases


def gradient_cases(sizes, quick):
    cases = []
    for n in sizes or ([4] if quick else [20]):
        for points in (1, 2, 3, 4):
            for method in ("direct", "adjoint"):
                cases.append(hertz(f"{method} {points * points}, boxes {n}", 16, [
                    "Task=sensitivity", "Accuracy/Estimate=none", f"Gradient/Method={method}",
                    "Gradient/Compare=false", f"Shape/Control points={points}, {points}",
                    *cubes(n)]))
    return cases


def bounds(text, factor):
    """The entries of all bounds in a parameter file, wider by a factor."""
    section, entries = "", []
    for line in text.splitlines():
        words = line.split("=")
        if line.startswith("subsection "):
            section = line[len("subsection "):].strip()
        elif len(words) == 2 and words[0].split() == ["set", "Bounds"]:
            ends = [float(end) * factor for end in words[1].split("#")[0].split(",")]
            entries.append(f"{section}/Bounds={ends[0]!r}, {ends[1]!r}")
    return entries


def optimization_cases(_sizes, quick):
    cases = []
    for path in sorted([*ROOT.glob("prm/*.prm"), *ROOT.glob("tests/scenes/*.prm")]):
        text = path.read_text()
        if not re.search(r"^set Task *= optimize", text, re.M) or "set Target" in text:
            continue
        name = str(path.relative_to(ROOT))
        for factor in (1., .2, 5., 100.):
            entries = [] if factor == 1. else bounds(text, factor)
            if quick:
                entries = entries + ["Optimization/Maximum evaluations=2"]
            if not quick or path.stem in ("two-bars", "tied-points"):
                cases.append(Case(f"{path.stem} (bounds x {factor:g})", name,
                                  ["Accuracy/Estimate=none", *entries]))
    return cases


def state_seconds(summary):
    return sum(summary["times"].get(stage, 0.)
               for stage in ("assembly", "factorization", "soft_modes", "solve"))


COLUMNS = {
    "whole": lambda s: {},
    "hard": lambda s: {"linear_f_mults": s["state"].get("linear_f_mults"),
                       "f_mults": s["state"].get("f_mults"),
                       "certificate": max(s["state"]["certificate"].values())},
    "ranks": lambda s: {"f_mults": s["work"]["f_mults"],
                        **{f"{count}_per_f_mult": round(value / s["work"]["f_mults"], 1)
                           for count, value in s["sent"].get("solve", NOTHING_SENT).items()},
                        **{f"MB_{stage}": round(value) for stage, value in
                           s.get("memory", {}).get("stages", {}).items()}},
    "gradient": lambda s: {"cold_states": round(s["times"]["gradient"] / state_seconds(s), 3),
                           "f_mults": s["gradient"]["f_mults"]},
    "optimization": lambda s: {"evaluations": s["optimization"]["evaluations"],
                               "iterations": s["optimization"]["iterations"],
                               "f_mults": s["work"]["f_mults"],
                               "objective": s["optimization"]["objective_final"],
                               "stopped": s["optimization"]["stop_reason"]}}

CASES = {"whole": whole_cases, "hard": hard_cases, "ranks": ranks_cases,
         "gradient": gradient_cases, "optimization": optimization_cases}


def environment():
    lines = (ROOT / "contrib/lib/run.env").read_text().splitlines()
    return {**os.environ, **dict(line.split("=", 1) for line in lines if "=" in line)}


def run(program, case, counter=None):
    """Its summary with seconds, CPU seconds, the largest memory of the process and, by the
    library @p counter, what ranks send in it."""
    with tempfile.TemporaryDirectory() as directory:
        sent = pathlib.Path(directory) / "messages.json"
        command = [str(program), str(ROOT / case.scene), "--output", directory]
        for entry in case.entries:
            command += ["--set", entry]
        if case.ranks > 1:
            counting = ["-x", f"LD_PRELOAD={counter}", "-x", f"SNUG_MESSAGES={sent}"]
            command = ["mpirun", "-np", str(case.ranks), *(counting if counter else []), *command]
        start = time.monotonic()
        with subprocess.Popen(command, env=environment(), text=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            said = process.stderr.read().strip()
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        # of a search that ends without meeting a tolerance as well
        if process.returncode not in (0, 3) or not (pathlib.Path(directory) / "summary.json").exists():
            raise RunError(f"{case.name}, {program}: status {process.returncode}: "
                           f"{(said.splitlines() or [''])[0]}")
        summary = json.loads((pathlib.Path(directory) / "summary.json").read_text())
        summary["sent"] = json.loads(sent.read_text()) if sent.exists() else {}
    summary.update(seconds=seconds, cpu=used.ru_utime + used.ru_stime, MB=used.ru_maxrss / 1024)
    return summary


def row_of(program, case, summaries, columns):
    """Medians of seconds; all else is the same in every repeat."""
    last = summaries[-1]
    row = {"program": program, "case": case.name, "ranks": case.ranks,
           "unknowns": last["mesh"]["dofs"], "subdomains": last["mesh"]["subdomains"],
           "seconds": round(statistics.median(s["seconds"] for s in summaries), 3),
           "cpu": round(statistics.median(s["cpu"] for s in summaries), 3),
           "MB": round(statistics.median(s["MB"] for s in summaries))}
    for stage in STAGES:
        row[stage] = round(statistics.median(s["times"].get(stage, 0.) for s in summaries), 3)
    row.update(columns(last))
    return row


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"), add_help=False)
    parser.add_argument("--help", action="version", version=__doc__)
    parser.add_argument("snug", type=pathlib.Path)
    parser.add_argument("name", choices=sorted(CASES))
    parser.add_argument("sizes", nargs="*", type=int)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--unknown", default=None)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_intermixed_args()
    programs = [program for program in (options.snug, options.against) if program]
    counter = next(iter(options.snug.absolute().parent.glob("libcount_messages.so")), None)
    writer = None
    for case in CASES[options.name](options.sizes, options.quick):
        summaries = collections.defaultdict(list)
        for _ in range(1 if options.quick else options.repeats):
            for program in programs:
                known = [entry for entry in case.entries if program == options.snug
                         or not options.unknown or not entry.startswith(options.unknown)]
                summaries[program].append(run(program, case._replace(entries=known), counter))
        for program in programs:
            row = row_of(program, case, summaries[program], COLUMNS[options.name])
            if writer is None:
                writer = csv.DictWriter(sys.stdout, row.keys(), extrasaction="ignore",
                                        restval="", lineterminator="\n")
                writer.writeheader()
            writer.writerow(row)
            sys.stdout.flush()


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"bench: {error}")
