"""What the built program says about the files of the project.

scenes: every prm file passes `snug --validate`.
parameters: doc/parameters.md is what `snug --print-parameters` prints."""

import difflib
import re
import subprocess

from files import place, text_files

REFERENCE = "doc/parameters.md"


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          timeout=60, check=False)


def check_scenes(root, program):
    messages = []
    for path in text_files(root, ("prm",), (".prm",)):
        done = run(program, "--validate", path)
        if done.returncode != 0:
            line = re.search(r"[Ll]ine <?(\d+)", done.stderr)
            said = " ".join(done.stderr.split()) or "(no message)"
            messages.append(f"{place(root, path, line.group(1) if line else 1)}"
                            f": exit status {done.returncode}: {said}")
    return messages


def check_parameters(root, program):
    done = run(program, "--print-parameters")
    if done.returncode != 0:
        return [f"{REFERENCE}:1: --print-parameters ends with"
                f" {done.returncode}: {done.stderr.strip()}"]
    path = root / REFERENCE
    written = path.read_text(encoding="utf-8") if path.is_file() else ""
    if written == done.stdout:
        return []
    old, new = written.splitlines(), done.stdout.splitlines()
    blocks = difflib.SequenceMatcher(None, old, new, autojunk=False)
    first = next((block for block in blocks.get_opcodes()
                  if block[0] != "equal"), ("", len(old) - 1, 0, 0, 0))
    return [f"{REFERENCE}:{first[1] + 1}: differs from what the program reads;"
            f" accept with: {program} --print-parameters > {REFERENCE}"]
