#!/usr/bin/env python3
"""Run every command of doc/tutorial.md: tutorial.py SNUG.

The commands are the blocks of the page with the language sh, which run one after the other in an
empty directory with links to the folders of the repository. The text of a block with the language
text that follows must occur in the output of the commands, line by line; '...' stands for any
text."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```(sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def missing(text, output):
    """Return the lines of a text that the output lacks."""
    lines = [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    found = " ".join(output.split())
    return [line for line in lines
            if not re.search(".*?".join(map(re.escape, line.split("..."))), found)]


def main():
    page = (ROOT / "doc/tutorial.md").read_text(encoding="utf-8")
    blocks = BLOCK.findall(page)
    output, failures = "", []
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        for name in ("contrib", "prm", "doc"):
            (directory / name).symlink_to(ROOT / name)
        (directory / "build").mkdir()
        (directory / "build/snug").symlink_to(pathlib.Path(sys.argv[1]).resolve())
        for language, text in blocks:
            if language == "text":
                failures += [f"not printed: {line}" for line in missing(text, output)]
                continue
            done = subprocess.run(["bash", "-eu", "-c", text], cwd=directory, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                                  env=os.environ, timeout=120)
            output = done.stdout
            if done.returncode != 0:
                failures.append(f"status {done.returncode} of:\n{text}\n{output}")
                break
    n_commands = sum(language == "sh" for language, _ in blocks)
    print(f"{n_commands} blocks of commands, {len(failures)} failures")
    print("\n".join(failures))
    return 1 if failures or n_commands < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
