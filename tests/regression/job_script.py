#!/usr/bin/env python3
"""The job script of Slurm without Slurm: job_script.py SNUG SCENE [--mpiexec MPIEXEC].

mpirun takes the place of srun, and a script that notes its arguments that of scontrol. An
optimization whose ranks get SIGTERM is put into the queue again, and the next job continues it to
its end, which is not."""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from interrupts import SECONDS, objectives, ranks_of

JOB = pathlib.Path(__file__).resolve().parents[2] / "contrib/slurm-job"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--mpiexec", default="mpirun")
    options = parser.parse_args()
    program, scene = map(os.path.realpath, (options.program, options.scene))
    failed = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        queue = folder / "queue"
        scontrol = folder / "scontrol"
        scontrol.write_text(f'#!/bin/sh\necho "$@" >>"{queue}"\n')
        scontrol.chmod(0o755)
        environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "SNUG": program,
                       "SNUG_LAUNCH": f"{options.mpiexec} -np 2", "SLURM_JOB_ID": "17"}
        output = folder / "output" / pathlib.Path(scene).stem

        def job(stop_after=None):
            """Return (status, log) of a job whose ranks get SIGTERM after so many evaluations."""
            with subprocess.Popen([str(JOB), scene, "--set", "Output/Compression=0"], cwd=folder,
                                  env=environment, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True) as process:
                while (stop_after is not None and process.poll() is None and
                       len(objectives(output)) < stop_after):
                    time.sleep(0.002)
                if stop_after is not None and process.poll() is None:
                    for rank in ranks_of(process.pid, program):
                        os.kill(rank, 15)
                log = process.communicate(timeout=SECONDS)[0]
                return process.returncode, log

        def expect(what, condition, log):
            print(f"{'good' if condition else 'WRONG'} {what}")
            if not condition:
                failed.append(what)
                print(log)

        status, log = job(stop_after=2)
        expect("an interrupted job is put into the queue again", status == 0 and queue.exists() and
               queue.read_text() == "requeue 17\n" and "restart" not in log, log)
        status, log = job()
        expect("the next job continues it to the end, once", status == 0 and
               "restart: reusing" in log and queue.read_text() == "requeue 17\n", log)
        expect("files of all ranks are not those of a rank",
               sorted(path.name for path in output.glob("warm-start.*")) ==
               ["warm-start.0", "warm-start.1"], list(output.iterdir()))
        none = subprocess.run([str(JOB)], env=environment, capture_output=True, text=True,
                              check=False)
        expect("a job without a model is refused", none.returncode == 2 and
               none.stderr.startswith("usage: "), none)
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
