"""The sources are as clang-format leaves them."""

import re
import shutil
import subprocess

from files import CODE, text_files

# The one version that both Debian 12 and 13 have; another one formats some lines differently.
VERSION = "19"


def find_program():
    """The clang-format of the wanted version, or None."""
    for name in (f"clang-format-{VERSION}", "clang-format"):
        program = shutil.which(name)
        if program:
            said = subprocess.run([program, "--version"], text=True,
                                  stdout=subprocess.PIPE, check=True).stdout
            if f"version {VERSION}." in said:
                return program
    return None


def check(root):
    program = find_program()
    if program is None:
        return [f".clang-format:1: no clang-format {VERSION} on the PATH"
                f" (Debian: apt install clang-format-{VERSION})"]
    files = list(text_files(root, ("include", "source", "tests"), CODE))
    if not files:
        return []
    done = subprocess.run([program, "--dry-run", "-Werror", *map(str, files)],
                          text=True, stderr=subprocess.PIPE, check=False)
    found = re.findall(r"^(.+?:\d+):\d+: error: code should be clang-formatted",
                       done.stderr, re.MULTILINE)
    messages = [f"{place.replace(str(root) + '/', '', 1)}: run clang-format-{VERSION} -i"
                for place in dict.fromkeys(found)]
    if done.returncode != 0 and not messages:
        messages = [f".clang-format:1: {done.stderr.strip()}"]
    return messages
