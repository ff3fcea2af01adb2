"""What the built program says about the files of the project.

scenes: every prm file passes `snug --validate`.
parameters: doc/parameters.md is what `snug --print-parameters` prints."""

import difflib
import pathlib
import re
import subprocess
import sys

from files import place, text_files

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from runs import execute_in_common  # noqa: E402

REFERENCE = "doc/parameters.md"
# Meshes of CAD files take long, and are valid with larger elements as well.
COARSE = {"step-roller.prm": ["Body rim/Element size=8", "Body rim/Face sizes=tread: 4",
                              "Body rim/Local refinements=0"],
          "step-punch.prm": ["Body punch/Element size=4", "Body punch/Face sizes=nose: 1.6"]}


def check_scenes(root, program):
    messages = []
    for path in text_files(root, ("prm",), (".prm",)):
        sizes = [word for entry in COARSE.get(path.name, []) for word in ("--set", entry)]
        status, _, said, *_ = execute_in_common([program, "--validate", str(path), *sizes])
        if status != 0:
            line = re.search(r"[Ll]ine <?(\d+)", said)
            said = " ".join(said.split()) or "(no message)"
            messages.append(f"{place(root, path, line.group(1) if line else 1)}"
                            f": exit status {status}: {said}")
    return messages


def check_parameters(root, program):
    done = subprocess.run([program, "--print-parameters"], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, timeout=60, check=False)
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
