#!/usr/bin/env python3
"""A run killed at an iteration and restarted takes the same path bit for bit.

Runs the scene once to the end; then again, killed (SIGKILL) as soon as its
journal holds n evaluations, and restarted, for several n. The journals must
agree in every design, objective, gradient and constraint; times may differ.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time


def command(args, output, *more):
    launcher = ([args.mpiexec, "-np", str(args.ranks)] if args.ranks > 1
                else [])
    return [*launcher, args.program, args.scene, "--output", output, *more]


def numbers(output):
    """The lines of the journal that must be equal."""
    with open(os.path.join(output, "journal.txt")) as journal:
        return [line for line in journal if not line.startswith("notes")]


def evaluations(output):
    try:
        with open(os.path.join(output, "journal.txt")) as journal:
            return sum(line.startswith("end ") for line in journal)
    except OSError:
        return 0


def kill_after(args, output, n):
    """Start the scene and kill it after n evaluations."""
    process = subprocess.Popen(command(args, output), start_new_session=True,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None and evaluations(output) < n:
        time.sleep(0.002)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(timeout=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpiexec", default="mpiexec")
    args = parser.parse_args()
    failures = 0
    with tempfile.TemporaryDirectory() as work:
        whole = os.path.join(work, "whole")
        subprocess.run(command(args, whole), check=True, timeout=120,
                       stdout=subprocess.DEVNULL)
        total = evaluations(whole)
        for n in (1, 2, total // 2, total - 1):
            output = os.path.join(work, f"killed-{n}")
            kill_after(args, output, n)
            reached = evaluations(output)
            subprocess.run(command(args, output, "--restart"), check=True,
                           timeout=120, stdout=subprocess.DEVNULL)
            same = numbers(output) == numbers(whole)
            print(f"killed after {reached} of {total} evaluations: "
                  f"{'same path' if same else 'ANOTHER PATH'}")
            failures += not same
            shutil.rmtree(output)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
