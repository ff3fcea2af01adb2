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
import pathlib
import re
import statistics
import sys
import tempfile

from runs import ROOT, RunError, run

Case = collections.namedtuple("Case", "name scene entries ranks", defaults=[1])

# what a rank sends in a stage, as count_messages.c has it
NOTHING_SENT = dict.fromkeys(["messages", "message_bytes", "collectives", "collective_bytes"], 0)

TORN = ["Task=state", "Accuracy/Estimate=none"]
STAGES = ["setup", "assembly", "factorization", "soft_modes", "solve", "gradient", "output"]


def cubes(n, *entries):
    """Return entries of both bodies of the paper's scene with n cells per edge."""
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
              *((f"clusters of {edge} per edge", "prm/hertz-3d-9.prm",
                 cubes(*((8, "Decomposition/Subdomains=128") if quick else
                         (30, "Decomposition/Subdomains=432")),
                       f"Decomposition/Subdomains per cluster edge={edge}"))
                for edge in (1, 2, 3)),
              ("nu 0.499, B-bar", "prm/hertz-3d-9.prm",
               cubes(n, *(f"Body {body}/{entry}" for body in ("punch", "foundation")
                          for entry in ("Poisson's ratio=0.499", "Formulation=B-bar"))))]
    return [Case(name, scene, linear + entries) for name, scene, entries in
            (scenes[:1] + scenes[8:] if quick else scenes)]


def growing(name, cells, ranks, mortar, entries=()):
    """Return a case of bodies that grow with the ranks: cells per edge of a body on one rank. Without
    soft modes, because only wide bodies have some, at the edges of the sphere."""
    # as many as ranks of them, as near to a square as powers of two allow
    across = 2 ** (ranks.bit_length() // 2)
    along = ranks // across
    grown = [f"Body {body}/Box {entry}"
             for body, corner, m in (("punch", 1, cells), ("foundation", 0, cells - 2 * mortar))
             for entry in (f"cells={m * across}, {m * along}, {m}",
                           f"size={across}, {along}, 1", f"corner=0, 0, {corner}")]
    method = ["Contact/Method=mortar"] if mortar else []
    return hertz(name, 9, [*TORN, *grown, "Solver/Soft modes=none", *method, *entries], ranks)


def ranks_cases(sizes, quick):
    n, counts = (6 if quick else 24), [2 ** k for k in range(1 + max(sizes or [2]).bit_length())]
    counts = [ranks for ranks in counts if ranks <= max(sizes or [2])]
    cases = [hertz("same work", 9, TORN + cubes(n), ranks) for ranks in counts]
    # about as many cells in flat bodies, with six times the contact rows
    wide, high = 5 * n // 2, n // 6
    flat = [f"Body {body}/Box {entry}" for body, z in (("punch", high / wide), ("foundation", 0.))
            for entry in (f"cells={wide}, {wide}, {high}", f"size=1, 1, {high / wide}",
                          f"corner=0, 0, {z}")]
    cases += [hertz("same work, flat", 9, TORN + flat + ["Solver/Soft modes=none"], ranks)
              for ranks in counts if ranks <= 2]
    # 15 cells make cubes of 5 cells on any number of ranks.
    per_rank = 3 if quick else 15
    joined = ["Decomposition/Subdomains per cluster edge=2"]
    for name, mortar, entries in (("more work", False, []), ("more work in clusters", False, joined),
                                  ("more work, mortar", True, []),
                                  ("more work, mortar in clusters", True, joined)):
        cases += [growing(name, per_rank, ranks, mortar, entries) for ranks in counts]
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
    """Return the entries of all bounds in a parameter file, wider by a factor."""
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


def columns_of(name, summary):
    """Return the columns of a benchmark of its own."""
    state, times = summary.get("state") or {}, summary["times"]
    if name == "hard":
        return {"linear_f_mults": state["linear_f_mults"], "f_mults": state["f_mults"],
                "certificate": max(state["certificate"].values())}
    if name == "ranks":
        f_mults = summary["work"]["f_mults"]
        return {"f_mults": f_mults,
                **{f"{count}_per_f_mult": round(value / f_mults, 1)
                   for count, value in summary["sent"].get("solve", NOTHING_SENT).items()},
                **{f"MB_{stage}": round(value)
                   for stage, value in summary["memory"]["stages"].items()}}
    if name == "gradient":
        seconds = sum(times[stage] for stage in
                      ("assembly", "factorization", "soft_modes", "solve"))
        return {"cold_states": round(times["gradient"] / seconds, 3),
                "f_mults": summary["gradient"]["f_mults"]}
    if name == "optimization":
        end = summary["optimization"]
        return {"evaluations": end["evaluations"], "iterations": end["iterations"],
                "f_mults": summary["work"]["f_mults"], "objective": end["objective_final"],
                "stopped": end["stop_reason"]}
    return {}


CASES = {"whole": whole_cases, "hard": hard_cases, "ranks": ranks_cases,
         "gradient": gradient_cases, "optimization": optimization_cases}


def summary_of(program, case, counter):
    """Return the summary of a run with seconds, CPU seconds, the largest memory of a process
    and, by the library counter, what ranks send in it."""
    with tempfile.TemporaryDirectory() as directory:
        sent = pathlib.Path(directory) / "messages.json"
        counting = ["-x", f"LD_PRELOAD={counter}", "-x", f"SNUG_MESSAGES={sent}"]
        # a search that ends without meeting a tolerance counts as well
        done = run(case.scene, case.entries, case.ranks, program=program, accepted=(0, 3),
                   launcher=counting if counter else (), timeout=36000)
        if not done.result:
            raise RunError(f"{case.name}, {program}: status {done.status}: {done.message}")
        return {**done.result.summary, "seconds": done.seconds, "cpu": done.cpu,
                "MB": done.megabytes,
                "sent": json.loads(sent.read_text()) if sent.exists() else {}}


def row_of(program, case, summaries, name):
    """Return medians of seconds; all else is the same in every repeat."""
    def median(value, digits=None):
        return round(statistics.median(map(value, summaries)), digits)
    last = summaries[-1]
    return {"program": program, "case": case.name, "ranks": case.ranks,
            "unknowns": last["mesh"]["dofs"], "subdomains": last["mesh"]["subdomains"],
            "clusters": last["mesh"]["clusters"], "contact_rows": last["mesh"]["contact_rows"],
            "seconds": median(lambda s: s["seconds"], 3), "cpu": median(lambda s: s["cpu"], 3),
            "MB": median(lambda s: s["MB"]),
            **{stage: median(lambda s, stage=stage: s["times"].get(stage, 0.), 3)
               for stage in STAGES}, **columns_of(name, last)}


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
    writer, first = None, {}
    for case in CASES[options.name](options.sizes, options.quick):
        summaries = collections.defaultdict(list)
        for _ in range(1 if options.quick else options.repeats):
            for program in programs:
                known = [entry for entry in case.entries if program == options.snug
                         or not options.unknown or not entry.startswith(options.unknown)]
                summaries[program].append(summary_of(
                    program, case._replace(entries=known), counter))
        for program in programs:
            row = row_of(program, case, summaries[program], options.name)
            if options.name == "ranks":
                # private memory of a rank at the end over that at the start, against the first row
                own = row["MB_output"] - row["MB_start"]
                row["growth"] = round(own / first.setdefault((program, case.name), own), 2)
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
