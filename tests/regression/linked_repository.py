"""Run the commands of contrib/ in a folder that links to the repository and its build.

Tests neither install nor compile: stand-ins of cmake, ctest and dpkg-query write down what the
commands ask them for, and every package is there. All else is as in a clone that is built."""

import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]

STAND_INS = {
    "cmake": """echo "cmake $*" >>"$ASKED"
while [ $# -gt 0 ]; do
  [ "$1" != -B ] || mkdir -p "$2"
  shift
done
""",
    # The number of tests that match and the exit status of the tests are given.
    "ctest": """echo "ctest $*" >>"$ASKED"
mkdir -p Testing/Temporary
touch Testing/Temporary/LastTest.log
[ "$1" != -N ] || exec echo "Total Tests: $TESTS"
exit "$STATUS"
""",
    "dpkg-query": """for word; do
  case $word in -*) ;; *) echo "$word installed" ;; esac
done
"""}


class LinkedRepository:
    """This class is such a folder."""

    def __init__(self, folder, build):
        self.root = pathlib.Path(folder)
        self.asked = self.root / "asked"
        for name, script in STAND_INS.items():
            path = self.root / "bin" / name
            path.parent.mkdir(exist_ok=True)
            path.write_text("#!/bin/sh\n" + script, encoding="utf-8")
            path.chmod(0o755)
        for name in ("contrib", "doc", "prm", "tests"):
            (self.root / name).symlink_to(ROOT / name)
        (self.root / "build").mkdir()
        for path in pathlib.Path(build).resolve().iterdir():
            if path.name not in ("Testing", "build.log"):  # the commands write these
                (self.root / "build" / path.name).symlink_to(path)

    def run(self, *words, **variables):
        """Return the finished process of a command, and what it asked the stand-ins for."""
        self.asked.write_text("", encoding="utf-8")
        done = subprocess.run(
            [str(self.root / words[0]), *words[1:]], cwd=self.root, text=True, check=False,
            stdin=subprocess.DEVNULL, capture_output=True,
            env={**os.environ, "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}",
                 "ASKED": str(self.asked), "PYTHONDONTWRITEBYTECODE": "1", **variables})
        return done, self.asked.read_text(encoding="utf-8").splitlines()


def targets(asked):
    """Return the targets that cmake was asked to build."""
    return [target for line in asked if line.startswith("cmake --build")
            for target in line.split(" --target ")[1].split(" --parallel ")[0].split()]
