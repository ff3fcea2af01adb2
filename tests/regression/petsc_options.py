#!/usr/bin/env python3
"""PETSc's options choose who factorizes, and change no answer: petsc_options.py SNUG SCENE.

By the command line and by the environment, of which the command line holds. What PETSc
lacks is refused with one line and status 2; what nobody asked for is named, and nothing
else, also where ranks have no subdomain.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PREFIXES = ("kplus", "dirichlet", "coarse", "soft_modes", "row_gram")
CLUSTERED = ("Decomposition/Subdomains per cluster edge=2",)
RTOL = 1e-7
RANKS = 5
THREE_CELLS = ("Decomposition/Subdomains=auto", "Body upper/Box cells=1, 1, 1",
               "Body lower/Box cells=2, 1, 1")


def by(package, *prefixes, kind="cholesky"):
    return " ".join(f"-{prefix}_pc_factor_mat_solver_type {package} -{prefix}_pc_type {kind}"
                    for prefix in prefixes)


class Runs:
    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.failed = 0

    def run(self, petsc="", environment="", entries=(), ranks=1):
        command = [self.options.program, self.options.scene, "--output", self.folder]
        for entry in ("Task=state", "Solver/Soft modes=all", "Solver/Relative tolerance=1e-9",
                      *entries):
            command += ["--set", entry]
        if petsc:
            command += ["--petsc", petsc]
        if ranks > 1:
            command = [self.options.mpiexec, "-np", str(ranks), *command]
        return subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env={**os.environ, "PETSC_OPTIONS": environment}, timeout=120,
                              check=False)

    def energy(self):
        summary = pathlib.Path(self.folder, "summary.json")
        return json.loads(summary.read_text(encoding="utf-8"))["state"]["energy"]

    def expect(self, what, good, done):
        print(("ok" if good else "FAILED") + ": " + what)
        if not good:
            self.failed += 1
            print(f"  status {done.returncode}\n{done.stdout}{done.stderr}")


def unused(done):
    return {line.split()[3] for line in done.stdout.splitlines()
            if line.startswith("warning: PETSc option ") and line.endswith(" was not used")}


def check_answers(runs):
    done = runs.run()
    runs.expect("without options", done.returncode == 0 and not unused(done), done)
    right = runs.energy()

    def expect_same(what, done):
        good = done.returncode == 0 and not unused(done)
        runs.expect(what, good and abs(runs.energy() - right) <= RTOL * abs(right), done)

    for package in ("petsc", "mumps"):
        expect_same(f"all by {package}", runs.run(by(package, *PREFIXES)))
    for prefix in PREFIXES:
        expect_same(f"{prefix} by mumps", runs.run(environment=by("mumps", prefix)))
    for package in ("petsc", "mumps", "superlu"):
        expect_same(f"all by LU of {package}", runs.run(by(package, *PREFIXES, kind="lu")))
    expect_same("clusters by mumps", runs.run(by("mumps", "clusters"), entries=CLUSTERED))
    expect_same("another order", runs.run("-kplus_pc_factor_mat_ordering_type rcm"))
    expect_same("kplus by mumps on two ranks", runs.run(by("mumps", "kplus"), ranks=2))
    expect_same("the command line over the environment",
                runs.run(by("petsc", "kplus"), by("no-such-package", "kplus")))


def check_errors(runs):
    for prefix in (*PREFIXES, "clusters"):
        done = runs.run(environment=by("no-such-package", prefix))
        runs.expect(f"no such package for {prefix}", done.returncode == 2 and
                    done.stderr.count("\n") == 1 and f"-{prefix}_pc" in done.stderr, done)
    done = runs.run(by("cholmod", "kplus", kind="lu"), ranks=2)
    runs.expect("no LU by CHOLMOD, on two ranks", done.returncode == 2 and
                "PETSc has no LU factorization by 'cholmod'" in done.stderr, done)
    done = runs.run("-kplus_pc_type jacobi")
    runs.expect("no factorization", done.returncode == 2 and "cholesky, lu" in done.stderr, done)
    for ranks in (1, RANKS):
        done = runs.run("-kplus_pc_type cholesky -k_plus_pc_type cholesky", "-misspelt",
                        THREE_CELLS, ranks)
        runs.expect(f"what nobody asked for, on {ranks} ranks", done.returncode == 0 and
                    unused(done) == {"-misspelt", "-k_plus_pc_type"}, done)
    done = runs.run("-misspelt -options_left")
    runs.expect("PETSc's own report", done.returncode == 0 and not unused(done) and
                "Option left: name:-misspelt" in done.stdout, done)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--mpiexec", default="mpirun")
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(parser.parse_args(), folder)
        check_answers(runs)
        check_errors(runs)
    return 1 if runs.failed else 0


if __name__ == "__main__":
    sys.exit(main())
