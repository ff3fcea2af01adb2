#!/usr/bin/env python3
"""The exported quadratic program: export_qp.py CHECK_QP SNUG SCENES --mpiexec MPIEXEC.

What contrib/check-qp finds by itself is what snug found, on one rank and two; a solution
that is none is told, and so is a folder without one."""

import argparse
import pathlib
import subprocess
import sys
import tempfile

FILES = {name + ending for name in ("K", "B", "R", "f", "g", "bounded", "u", "lambda")
         for ending in (".petsc", ".mtx")}
SMALL = {"two-blocks-2d.prm": [], "nonmatching-3d.prm": ["Decomposition/Subdomains=4"],
         "two-materials.prm": []}


def run(command):
    return subprocess.run([str(word) for word in command], text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def main():
    parser = argparse.ArgumentParser()
    for name in ("check", "snug", "scenes"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--mpiexec", default="mpirun")
    options = parser.parse_args()
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder)
        for scene, entries in SMALL.items():
            for ranks in (1, 2):
                command = [options.mpiexec, "-np", ranks] if ranks > 1 else []
                command += [options.snug, options.scenes / scene, "--output", output]
                for entry in ["Task=state", "Accuracy/Estimate=none", "Output/Export QP=true",
                              "Solver/Relative tolerance=1e-8", *entries]:
                    command += ["--set", entry]
                done = run(command)
                found = {path.name for path in (output / "qp").glob("*")}
                checked = run([options.check, output / "qp"])
                print(scene, ranks, "ranks\n" + checked.stdout)
                if done.returncode != 0 or found != FILES or checked.returncode != 0:
                    wrong.append(f"{scene} on {ranks} ranks: {done.stdout[-300:]}")
            *head, first, rest = (output / "qp" / "u.mtx").read_text().split("\n", 3)
            worse = float(first) + 1e-3 * max(abs(float(word)) for word in rest.split())
            (output / "mine.mtx").write_text("\n".join([*head, repr(worse), rest]))
            if run([options.check, output / "qp", "--solution",
                    output / "mine.mtx"]).returncode != 1:
                wrong.append(f"{scene}: a wrong solution is not told")
        # a run without it leaves none
        run([options.snug, options.scenes / "two-blocks-2d.prm", "--output", output])
        if any(path.name in FILES for path in (output / "qp").glob("*")):
            wrong.append("files of an earlier run stay")
        if run([options.check, output / "qp"]).returncode != 2:
            wrong.append("a folder without a problem is not told")
    print("\n".join(wrong) or "all right")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
