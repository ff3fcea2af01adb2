#!/usr/bin/env python3
"""A program outside of the project builds with the installed package and
computes what the installed snug does: outside_program.py BUILD SCENE WORK."""

import json
import pathlib
import shutil
import subprocess
import sys


def run(*command):
    done = subprocess.run([str(word) for word in command], text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit status {done.returncode}\n"
                 + done.stdout)
    return done.stdout


def main():
    build, scene, work = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    installed, outside = work / "installed", work / "outside"
    run("cmake", "--install", build, "--prefix", installed)
    run("cmake", "-S", pathlib.Path(__file__).resolve().parent, "-B", outside,
        f"-DCMAKE_PREFIX_PATH={installed}", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
    run("cmake", "--build", outside)
    # the log comes before
    energy = float(run(outside / "solve_scene", scene).splitlines()[-1])
    run(installed / "bin" / "snug", scene, "--output", work / "output")
    summary = json.loads((work / "output" / "summary.json").read_text())
    known = summary["state"]["energy"]
    if abs(energy - known) > 1e-12 * abs(known):
        sys.exit(f"the outside program finds the energy {energy}, snug {known}")
    print(f"energy {energy}, as snug finds it")


if __name__ == "__main__":
    main()
