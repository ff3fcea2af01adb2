"""The program shellcheck finds nothing in the shell scripts."""

import re
import shutil
import subprocess

from files import lines, text_files

SHEBANG = re.compile(r"#!.*\b(ba|da)?sh\b")


def is_script(path):
    """Return whether a file is a shell script, by its suffix or its first line."""
    first = next((line for _, line in lines(path)), "")
    return path.suffix == ".sh" or SHEBANG.match(first) is not None


def check(root):
    if shutil.which("shellcheck") is None:
        return ["contrib:1: no shellcheck on the PATH (Debian: apt install shellcheck)"]
    scripts = [path.relative_to(root) for path in text_files(root, (".ci", "contrib", "tests"))
               if is_script(path)]
    if not scripts:
        return []
    # --external-sources: functions and variables of the files that a script reads are known.
    done = subprocess.run(["shellcheck", "--external-sources", "--format=gcc", *map(str, scripts)],
                          cwd=root, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          check=False)
    return done.stdout.splitlines() or (
        [f"contrib:1: shellcheck ends with {done.returncode}"] if done.returncode else [])
