#!/usr/bin/env python3
"""Every benchmark of contrib/bench on its smallest size: bench.py BUILD.

state and coarse print tables of their own. The others print one row per case and program, of which
whole has two, with all of their columns filled in."""

import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from linked_repository import ROOT, LinkedRepository, targets

LIB = ROOT / "contrib" / "lib"
# columns that a row must have above zero, and the number of cases
EXPECTED = {"whole": (["seconds", "cpu", "MB", "setup", "solve"], 2),
            "hard": (["linear_f_mults", "f_mults"], 7),
            "ranks": (["f_mults", "MB_solve"], 12),
            "gradient": (["cold_states"], 8),
            "optimization": (["evaluations", "f_mults"], 8)}
# columns above zero where several ranks work together
SENT = ["messages_per_f_mult", "message_bytes_per_f_mult", "collectives_per_f_mult",
        "collective_bytes_per_f_mult"]


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.repository = LinkedRepository(folder.name, BUILD)

    def bench(self, *words, built, **variables):
        """Return what a benchmark prints, which must have asked for these targets."""
        done, asked = self.repository.run("contrib/bench", *words, **variables)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(targets(asked), built)
        return done.stdout

    def check_whole_runs(self, name):
        """Check the rows of a benchmark of whole runs, and return what it prints."""
        columns, n_cases = EXPECTED[name]
        programs = ["--against", str(BUILD / "snug")] if name == "whole" else []
        built = ["snug", "count_messages"] if name == "ranks" else ["snug"]
        text = self.bench(name, "--quick", *programs, built=built)
        rows = list(csv.DictReader(text.splitlines()))
        self.assertEqual(len(rows), 2 * n_cases if programs else n_cases, text)
        for row in rows:
            several = name == "ranks" and row["ranks"] != "1"
            for column in columns + (SENT if several else []):
                self.assertGreater(float(row[column]), 0., f"{column} of {row['case']}")
        return text

    def test_whole(self):
        self.check_whole_runs("whole")

    def test_hard(self):
        self.check_whole_runs("hard")

    def test_gradient(self):
        self.check_whole_runs("gradient")

    def test_optimization(self):
        self.check_whole_runs("optimization")

    def test_ranks_and_the_cost_model_of_many_ranks(self):
        """The model finds the powers and the gain of a team that a table of the coarse problem was
        made of."""
        paths = [self.repository.root / name for name in ("ranks.csv", "coarse.csv")]
        paths[0].write_text(self.check_whole_runs("ranks"))
        paths[1].write_text("ranks,subdomains,factorization,solve,MB\n" + "".join(
            f"{ranks},{n},{wall * 1e-8 * n ** 2},{wall * 1e-7 * n ** 1.25},{1e-3 * n ** 1.5 / ranks}\n"
            for ranks, wall in ((1, 1.), (4, 1.5)) for n in (100, 1000, 5000)))
        done = subprocess.run([sys.executable, "-B", LIB / "scaling.py", *paths], text=True,
                              check=True, capture_output=True)
        self.assertIn("factorization 2.00, solve 1.25, memory 1.50", done.stdout)
        self.assertIn("team of 4: factorization 0.75 of one rank's, solve 0.75, memory 0.25",
                      done.stdout)
        # with clusters, and for comparison without
        self.assertEqual(len(re.findall(r"^\| 1\.\de\+0", done.stdout, re.MULTILINE)), 7 + 2)

    def test_state(self):
        text = self.bench("state", "3", built=["benchmark.state"], REPEATS="1")
        for name in ("state", "CHOLMOD", "MUMPS", "GAMG-CG"):
            steps, factor, solve = re.search(rf" {name} +(\d+) +([\d.]+) +([\d.]+)", text).groups()
            self.assertGreater(int(steps), 0, name)
            self.assertGreaterEqual(float(factor) + float(solve), 0., name)
        stages = re.search(r"\n3\^3 cells, \d+ subdomains, CPU seconds.*\n((?:  .+\n)+)", text)
        counts = dict(re.findall(r"^  (.+?) +(\d+) x ", stages[1], re.MULTILINE))
        self.assertEqual(len(counts), 8, text)
        steps = re.search(r" state +(\d+)", text)[1]
        self.assertEqual(counts["F"], steps)

    def test_coarse(self):
        text = self.bench("coarse", "2", built=["benchmark.coarse"], REPEATS="1", TEAMS="2")
        rows = list(csv.DictReader(text.splitlines()))
        # six modes of each of 2^3 subdomains
        self.assertEqual([(row["ranks"], row["subdomains"], row["modes"]) for row in rows],
                         [(ranks, "8", "48") for ranks in ("1", "2")])
        for row in rows:
            self.assertGreater(float(row["solve"]), 0.)

    def test_no_benchmark_of_that_name(self):
        done, asked = self.repository.run("contrib/bench", "states")
        self.assertEqual((done.returncode, asked), (2, []))
        self.assertIn("usage: contrib/bench NAME", done.stderr)

    def test_a_program_that_fails_is_one_line(self):
        done = subprocess.run([sys.executable, "-B", LIB / "benchmarks.py", "/bin/false", "whole",
                               "--quick"], text=True, check=False, capture_output=True)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    arguments, others = parser.parse_known_args()
    BUILD = arguments.build
    unittest.main(argv=[sys.argv[0], *others])
