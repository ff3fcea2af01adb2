#!/usr/bin/env python3
"""A program outside of the project builds with the installed package and
computes what the installed snug does, and the packages of debian/ have all
installed files: outside_program.py BUILD SCENE WORK."""

import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*command):
    done = subprocess.run([str(word) for word in command], text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit status {done.returncode}\n"
                 + done.stdout)
    return done.stdout


def check_packages(installed):
    """Every line of debian/*.install names files, and every installed file is in a package."""
    left = {path for path in installed.rglob("*") if path.is_file()}
    for listing in [*(ROOT / "debian").glob("*.install"), ROOT / "debian" / "not-installed"]:
        for pattern in (line.split()[0] for line in listing.read_text().splitlines()):
            below = pattern.removeprefix("usr/").replace("lib/*/", "lib/**/")
            found = [*installed.glob(below), *ROOT.glob(pattern)]
            if not found:
                sys.exit(f"debian/{listing.name}: no file is installed as '{pattern}'")
            left -= {path for path in left if not {path, *path.parents}.isdisjoint(found)}
    if left:
        sys.exit(f"no package of debian/ has {', '.join(map(str, sorted(left)))}")


def main():
    build, scene, work = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    installed, outside = work / "installed", work / "outside"
    run("cmake", "--install", build, "--prefix", installed)
    check_packages(installed)
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
