#!/usr/bin/env python3
"""A run whose memory ends says so in one line, with status 1: memory.py SNUG SCENE.

The limit is one of the address space, as some batch systems set it. Little more than the
program needs to start is enough for the scene, but not for the same scene with more cells,
wherever that one comes to its end: in the mesh, the matrices or their factorization.
"""

import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

FINE = [f"Body {body}/Box cells=16,16,16" for body in ("upper", "lower")]
MB = 1 << 20
SECONDS = 60


def run(args, folder, limit, entries=()):
    """(status, standard error) within so many bytes of address space."""
    command = [args.program, args.scene, "--output", str(pathlib.Path(folder, "output"))]
    for entry in (*entries, "Decomposition/Subdomains=2"):
        command += ["--set", entry]
    try:
        done = subprocess.run(command, text=True, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, timeout=SECONDS, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                                    (limit, limit)))
    except subprocess.TimeoutExpired:
        return None, f"no end within {SECONDS} s"
    return done.returncode, done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    args = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        # libraries and MPI take hundreds of MB; what fails below that is not ours to say
        enough = 800 * MB
        while run(args, folder, enough)[0] != 0:
            enough += 100 * MB
            if enough > 4000 * MB:
                sys.exit("the small scene takes more than 4 GB")
        print(f"the small scene needs {enough // MB} MB")
        for more in (0, 50):
            for package in ("CHOLMOD", "MUMPS"):
                status, said = run(args, folder, enough + more * MB,
                                   [*FINE, f"Solver/Factorization={package}"])
                good = (status == 1 and said.count("\n") == 1 and
                        said.startswith("snug: out of memory: "))
                print(f"{'good' if good else 'WRONG'}: {more} MB more, {package}")
                if not good:
                    print(f"status {status}, it says {said!r}")
                failed += not good
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
