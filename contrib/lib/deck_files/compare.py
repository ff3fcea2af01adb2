"""Run a deck by Snug and by CalculiX, and compare displacements."""

import json
import pathlib
import subprocess

from calculix import fields
from runs import environment

EXACT = ["Solver/Relative tolerance=1e-10", "Accuracy/Estimate=none"]

NOT_LINKED = {", solver=PASTIX": ""}  # with CalculiX of Debian


class DeckError(Exception):
    """This class tells that a program did not run a deck."""


def write(files, folder):
    """Write the files of a deck, and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "deck.inp"


def run(words, folder):
    return subprocess.run([str(word) for word in words], cwd=folder, env=environment(), text=True,
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          errors="replace")


def responses(model):
    """Return entries of displacements at the points of a model."""
    entries = ["Responses=" + ", ".join(f"u{i}" for i in range(len(model.probes)))]
    for i, probe in enumerate(model.probes):
        point = ", ".join(f"{x:.14g}" for x in model.position(probe.node))
        entries += [f"Response u{i}/Quantity=displacement",
                    f"Response u{i}/Point={point}",
                    f"Response u{i}/Component=" + "xyz"[probe.component]]
    return entries


def displacements(summary, model):
    """Return the displacements at the points in a summary, one list for each step."""
    cases = summary.get("load_cases", [summary])
    return [[case["state"]["responses"][f"u{i}"] for i in range(len(model.probes))]
            for case in cases]


def by_snug(snug, deck, model):
    """Return the displacements at the points, one list for each step."""
    output = deck.parent / "snug"
    sets = [word for entry in [*EXACT, *responses(model)] for word in ("--set", entry)]
    done = run([snug, deck, "--output", output, *sets], deck.parent)
    (deck.parent / "snug.log").write_text(done.stdout, encoding="utf-8")
    if done.returncode != 0:
        raise DeckError("Snug: " + done.stdout[-600:])
    return displacements(json.loads((output / "summary.json").read_text(encoding="utf-8")), model)


def by_calculix(deck, model):
    """Return the displacements at the points at the end of each step."""
    done = run(["ccx", deck.stem], deck.parent)
    if "Job finished" not in done.stdout:
        raise DeckError("CalculiX: " + done.stdout[-600:])
    steps = fields(deck.with_suffix(".frd"), "DISP")
    return [[steps[step][probe.node][probe.component] for probe in model.probes]
            for step in sorted(steps)]


def difference(found, expected):
    """Return the largest difference over the largest of the expected displacements of a step."""
    assert len(found) == len(expected), (found, expected)
    return max(max(abs(a - b) for a, b in zip(one, other)) / max(map(abs, other))
               for one, other in zip(found, expected))


def compare(snug, example, folder):
    """Return the difference between Snug and CalculiX, and the displacements of both."""
    deck = write(example.files, pathlib.Path(folder) / "read")
    files = dict(example.ccx or example.files)
    for name, text in files.items():
        for old, new in {**NOT_LINKED, **example.model.ccx_lines}.items():
            text = text.replace(old, new)
        files[name] = text
    found = by_snug(snug, deck, example.model)
    expected = by_calculix(write(files, pathlib.Path(folder) / "ccx"), example.model)
    return difference(found, expected), found, expected
