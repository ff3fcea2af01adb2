#!/usr/bin/env python3
"""The shell commands of contrib/ that no other test calls, on small sizes: commands.py BUILD."""

import argparse
import json
import pathlib
import sys
import tempfile
import unittest

from linked_repository import LinkedRepository, targets


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.repository = LinkedRepository(folder.name, BUILD)

    def run_command(self, status, *words, **variables):
        done, asked = self.repository.run(*words, **variables)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done, asked

    def test_run_solves_and_draws(self):
        output = self.repository.root / "results"
        done, asked = self.run_command(0, "contrib/run", "tests/scenes/two-blocks-2d.prm",
                                       "--set", "Decomposition/Subdomains=2", "--output",
                                       str(output), RANKS="2")
        self.assertEqual(targets(asked), ["snug"])
        self.assertEqual(done.stdout.splitlines()[-1], f"Results are in {output}")
        summary = json.loads((output / "summary.json").read_text(encoding="utf-8"))
        self.assertEqual(summary["mesh"]["ranks"], 2)
        self.assertTrue(list(output.glob("*.png")))

    def test_run_refuses_what_it_cannot_read(self):
        done, asked = self.run_command(2, "contrib/run", "prm/nothing.prm")
        self.assertIn("cannot read the parameter file 'prm/nothing.prm'", done.stderr)
        self.assertEqual(asked, [])

    def test_lint_compiles_a_header(self):
        done, _ = self.run_command(0, "contrib/lint", "--alone",
                                   str(ROOT / "include/snug/base/choice.h"))
        self.assertEqual(done.stdout, "alone: 1 files compiled, 0 to mend\n")

    def test_random_problems_are_solved(self):
        done, asked = self.run_command(0, "contrib/studies/random-problems", "801", "802")
        self.assertEqual(targets(asked), ["random.problems"])
        head, _, *kinds = (line.split(" | ") for line in done.stdout.splitlines()
                           if line.startswith("|"))
        self.assertEqual(head[1:3], ["problems", "solved"])
        self.assertEqual(sum(int(cells[1]) for cells in kinds), 2, done.stdout)

    def test_test_tells_what_fails(self):
        done, _ = self.run_command(0, "contrib/test", "-L", "unit", TESTS="3", STATUS="0")
        self.assertIn("All tests passed.", done.stdout)
        done, _ = self.run_command(1, "contrib/test", "-L", "unit", TESTS="3", STATUS="8")
        self.assertIn("failed in build", done.stderr)
        done, _ = self.run_command(1, "contrib/test", "-L", "none", TESTS="0", STATUS="0")
        self.assertIn("no test matches: -L none", done.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    arguments, others = parser.parse_known_args()
    BUILD, ROOT = arguments.build, pathlib.Path(__file__).resolve().parents[2]
    unittest.main(argv=[sys.argv[0], *others])
