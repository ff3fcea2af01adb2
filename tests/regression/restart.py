#!/usr/bin/env python3
"""A run killed at an iteration and restarted takes the same path bit for bit.

Runs the scene once to the end; then again, killed (SIGKILL) as soon as its
journal holds n evaluations, and restarted, for several n. The journals must
agree in every design, objective, gradient and constraint; times may differ.
Finally SIGTERM must end a run early and cleanly, with status 0 and its results
written (on one rank, without a launcher that has its own idea of signals).
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


def run_until(args, output, n, number):
    """Start the scene and send it a signal after n evaluations."""
    process = subprocess.Popen(command(args, output), start_new_session=True,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None and evaluations(output) < n:
        time.sleep(0.002)
    if process.poll() is None:
        if number == signal.SIGKILL:
            os.killpg(process.pid, number)
        else:
            process.send_signal(number)
    return process.wait(timeout=120)


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
            run_until(args, output, n, signal.SIGKILL)
            reached = evaluations(output)
            subprocess.run(command(args, output, "--restart"), check=True,
                           timeout=120, stdout=subprocess.DEVNULL)
            same = numbers(output) == numbers(whole)
            print(f"killed after {reached} of {total} evaluations: "
                  f"{'same path' if same else 'ANOTHER PATH'}")
            failures += not same
            shutil.rmtree(output)
        if args.ranks == 1:
            output = os.path.join(work, "ended")
            status = run_until(args, output, 1, signal.SIGTERM)
            reached = evaluations(output)
            clean = (status == 0 and reached < total and
                     os.path.exists(os.path.join(output, "summary.json")))
            print(f"SIGTERM: status {status} after {reached} of {total} "
                  f"evaluations: {'clean' if clean else 'NOT CLEAN'}")
            failures += not clean
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
