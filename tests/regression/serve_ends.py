#!/usr/bin/env python3
"""How resident processes end, and what the Python package says: serve_ends.py SNUG SCENE."""

import json
import os
import pathlib
import resource
import signal
import stat
import sys
import tempfile
import time
import unittest

try:
    import numpy  # noqa: F401
except ImportError:  # Debian's Python has it
    if os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3"):
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

CONTRIB = pathlib.Path(__file__).resolve().parents[2] / "contrib"
sys.path[:0] = [str(CONTRIB / "lib"), str(CONTRIB / "python")]
import snug  # noqa: E402
from runs import environment  # noqa: E402
from serving import descendants, seconds_after_killed_client, seconds_until_gone  # noqa: E402

SECONDS = 10.  # within which no process is left
LARGE = {f"Body {body}/Box cells": [900, 700] for body in ("upper", "lower")}


def number_of(pid):
    """Return the rank of a process, or None if it is no rank."""
    lines = pathlib.Path(f"/proc/{pid}/environ").read_bytes().decode().split("\0")
    return next((int(line.partition("=")[2]) for line in lines
                 if line.startswith("OMPI_COMM_WORLD_RANK=")), None)


class Ends(unittest.TestCase):
    def model(self, ranks=2, program=None, entries=None):
        model = snug.Model(SCENE, entries, ranks=ranks, program=program or PROGRAM, timeout=60.)
        self.addCleanup(model.close)
        self.process = model.process.process
        self.all = [self.process.pid, *descendants(self.process.pid)]
        self.ranks = {number_of(pid): pid for pid in self.all[1:] if number_of(pid) is not None}
        return model

    def assert_gone(self):
        self.assertLess(seconds_until_gone(self.all), SECONDS)

    def assert_died(self, work, pattern):
        with self.assertRaisesRegex(snug.Died, pattern):
            work()
        self.assert_gone()

    def test_killed_clients(self):
        for ranks in (1, 2):
            self.assertLess(seconds_after_killed_client(SCENE, (), ranks), SECONDS)

    def test_signals_while_idle(self):
        for ranks in (1, 2):
            model = self.model(ranks)
            model.evaluate()
            self.process.send_signal(signal.SIGTERM)
            self.assert_gone()
            # Open MPI's mpirun keeps the last words of ranks to itself after a signal.
            self.assert_died(model.describe, "ended by a signal" if ranks == 1 else "exit status 1")

    def test_signals_during_a_request(self):
        for ranks in (1, 2):
            self.model(ranks)
            self.process.stdin.write('{"do": "set", "entries": {"Body upper/Box cells": '
                                     '[600, 400]}}\n{"do": "describe"}\n')
            self.process.stdin.flush()
            time.sleep(.3)
            self.process.send_signal(signal.SIGTERM)
            if ranks == 1:  # mpirun ends the ranks at once
                self.assertEqual(json.loads(self.process.stdout.readline())["rebuilt"], ["mesh"])
                kind = json.loads(self.process.stdout.readline())["error"]["kind"]
                self.assertEqual(kind, "interrupted")
            self.assert_gone()

    def test_a_killed_rank(self):
        model = self.model()
        os.kill(self.ranks[1], signal.SIGKILL)
        self.assert_died(model.evaluate, "signal 9")
        model = self.model(1)
        self.process.kill()
        self.assert_died(model.evaluate, "signal SIGKILL")

    def test_memory_of_one_rank(self):
        """The other rank waits for a message of the one that has no memory."""
        model = self.model()
        model.evaluate()
        used = pathlib.Path(f"/proc/{self.ranks[1]}/statm").read_text(encoding="ascii").split()[0]
        most = int(used) * resource.getpagesize() + (1 << 20)
        resource.prlimit(self.ranks[1], resource.RLIMIT_AS, (most, -1))
        self.assert_died(lambda: model.set(LARGE), "snug: out of memory")

    def test_a_full_disk(self):
        """Files end after 4 kB, whose signal is ignored. The server goes on."""
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "snug-on-a-full-disk")
            program.write_text(f"#!/bin/sh\ntrap '' XFSZ\nexec {PROGRAM} \"$@\"\n",
                               encoding="utf-8")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
            model = self.model(program=program, entries={"Output directory": folder + "/out"})
            first = model.evaluate([.01, -.02, .03])
            for pid in self.ranks.values():
                resource.prlimit(pid, resource.RLIMIT_FSIZE, (4096, -1))
            with self.assertRaisesRegex(snug.SnugError, "cannot write '.*': File too large"):
                model.write([.01, -.02, .03])
            again = model.process.call("evaluate", x=[.01, -.02, .03])
            self.assertEqual(again["values"], first.values)


if __name__ == "__main__":
    PROGRAM, SCENE = sys.argv[1:3]
    os.environ.update(environment())
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], warnings="ignore")
