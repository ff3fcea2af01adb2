#!/usr/bin/env python3
"""SIGTERM and SIGINT end a run soon: interrupts.py SNUG SCENE [--ranks N].

An optimization goes on to the end of its evaluation, writes the results of its best
design and ends with status 0, whichever rank got the signal; a second signal ends it at
once. States and sensitivities end at once. The ranks get the signal, not their launcher,
which has its own idea of signals: Open MPI kills what does not end within a second.
METIS catches SIGTERM while it works: a signal must end the run as ever. An interrupted
optimization goes on with its record on another number of ranks as well.
"""

import argparse
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

SECONDS = 60  # much more than an evaluation, on a busy machine

# METIS partitions it for a tenth of a second.
PARTITIONED = """
set Bodies = upper, lower
set Task = state
subsection Body upper
  set Box corner = 0, 0, 1
  set Box cells = {0}
  set Supports = left: x, front: y
  set Pressure = top: 1
end
subsection Body lower
  set Box cells = {0}
  set Supports = bottom: xyz
end
subsection Contact
  set Pairs = upper.bottom: lower.top
end
subsection Decomposition
  set Method = METIS
  set Subdomains = 100
end
""".format("28, 28, 20")


def descendants(process):
    yield process
    for child in pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split():
        yield from descendants(int(child))


def ranks_of(process, program):
    """Process ids of the ranks: what runs the program, below a launcher or by itself."""
    return [rank for rank in descendants(process)
            if os.path.realpath(f"/proc/{rank}/exe") == program]


def catches(process, number):
    """Whether a process has a handler for a signal."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False
    return int(re.search(r"SigCgt:\s*(\w+)", status).group(1), 16) >> (number - 1) & 1 == 1


def objectives(output):
    """Those of the evaluations in the journal; a last one may not be whole yet."""
    try:
        lines = (output / "journal.txt").read_text().splitlines()
    except OSError:
        return []
    values = [float.fromhex(line.split()[1]) for line in lines if line.startswith("objective ")]
    return values[:sum(line.startswith("end ") for line in lines)]


class Check:
    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)
        self.failed = 0

    def command(self, scene, output, ranks):
        launcher = ([self.options.mpiexec, "-np", str(ranks)] if ranks > 1 else [])
        return [*launcher, self.options.program, scene, "--output", str(output)]

    def start(self, name, *entries, scene=None):
        output = self.folder / name
        command = self.command(scene or self.options.scene, output, self.options.ranks)
        for entry in entries:
            command += ["--set", entry]
        return output, subprocess.Popen(command, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True)

    def wait_until(self, process, condition):
        while process.poll() is None and not condition():
            time.sleep(0.002)

    def verdict(self, name, process, status, *problems):
        """Wait for the end; whether it is the expected one."""
        begin = time.monotonic()
        try:
            said = process.communicate(timeout=SECONDS)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            said = process.communicate()[1] + f"no end within {SECONDS} s"
        good = process.returncode == status
        print(f"{'good' if good else 'WRONG'} {name}: status {process.returncode} "
              f"{time.monotonic() - begin:.1f} s after the signal")
        if not good:
            print(said)
        self.failed += not good
        return good

    def killed(self, number):
        """The exit status of a run that ends by a signal, as launcher or shell have it."""
        return -number if self.options.ranks == 1 else 128 + number

    def ends_at_once(self, task, number):
        output, process = self.start(f"{task}-{number}", f"Task={task}")
        self.wait_until(process, (output / "parameters.prm").exists)
        if process.poll() is None:
            os.kill(ranks_of(process.pid, self.options.program)[-1], number)
        self.verdict(f"{task}, signal {number}", process, self.killed(number))

    def keeps_the_best(self, number, which):
        output, process = self.start(f"best-{number}")
        # all of the scene's designs keep the volume, and the best one so far is not the last
        self.wait_until(process, lambda: len(objectives(output)) >= 4)
        if process.poll() is None:
            os.kill(ranks_of(process.pid, self.options.program)[which], number)
        if not self.verdict(f"optimize, signal {number}", process, 0):
            return
        summary = json.loads((output / "summary.json").read_text())["optimization"]
        done = objectives(output)
        found = [name for name, wrong in {
            "it did not stop by the signal": summary["stop_reason"] != "interrupted",
            "its design is not the best": summary["objective_final"] != min(done),
            "no pictures": not list(output.rglob("solution.pvd"))}.items() if wrong]
        self.failed += len(found)
        for problem in found:
            print(f"WRONG {problem}: {summary}, evaluations {done}")
        self.goes_on_with_other_ranks(output, len(done))

    def goes_on_with_other_ranks(self, output, n_done):
        """Sums over ranks differ by rounding, and the designs with them."""
        ranks = 3 if self.options.ranks == 1 else self.options.ranks - 1
        run = subprocess.run([*self.command(self.options.scene, output, ranks), "--restart"],
                             capture_output=True, text=True, timeout=SECONDS, check=False)
        good = (run.returncode == 0 and "restart: reusing" in run.stdout and
                "another design" not in run.stdout and len(objectives(output)) > n_done)
        print(f"{'good' if good else 'WRONG'} restart on {ranks} ranks after {n_done} values")
        if not good:
            print(run.stdout, run.stderr)
        self.failed += not good

    def ends_within_metis(self):
        """The handler is that of METIS: states have none of their own."""
        scene = self.folder / "partitioned.prm"
        scene.write_text(PARTITIONED)
        _, process = self.start("partitioned", scene=str(scene))

        def metis_works():
            return any(catches(rank, signal.SIGTERM)
                       for rank in ranks_of(process.pid, self.options.program))
        self.wait_until(process, metis_works)
        for rank in ranks_of(process.pid, self.options.program):
            if catches(rank, signal.SIGTERM):
                os.kill(rank, signal.SIGTERM)
                break
        self.verdict("METIS, SIGTERM", process, self.killed(signal.SIGTERM))

    def second_signal(self, number):
        # finer, so that what follows the first one lasts until the second
        text = pathlib.Path(self.options.scene).read_text()
        bodies = re.search(r"^set Bodies *= *(.*)$", text, re.MULTILINE).group(1).split(",")
        output, process = self.start("twice", *(f"Body {body.strip()}/Refinements=1"
                                                for body in bodies))
        self.wait_until(process, lambda: objectives(output))
        for _ in range(2):
            if process.poll() is None:
                process.send_signal(number)
            self.wait_until(process, lambda: not catches(process.pid, number))
        self.verdict(f"two signals {number}", process, -number)
        self.failed += (output / "summary.json").exists()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpiexec", default="mpiexec")
    options = parser.parse_args()
    options.program = os.path.realpath(options.program)
    with tempfile.TemporaryDirectory() as folder:
        check = Check(options, folder)
        check.ends_at_once("state", signal.SIGTERM)
        check.ends_at_once("sensitivity", signal.SIGINT)
        check.ends_within_metis()
        check.keeps_the_best(signal.SIGTERM, 0)
        check.keeps_the_best(signal.SIGINT, -1)
        if options.ranks == 1:
            check.second_signal(signal.SIGTERM)
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main())
