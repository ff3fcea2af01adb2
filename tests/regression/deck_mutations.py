#!/usr/bin/env python3
"""Count the answers of Snug to decks with a mistake: deck_mutations.py SNUG MESHES [--show].

Ten changes of each of eleven decks with a fixed seed: a line removed, doubled or misspelt, a name or an
option changed, numbers swapped, a comma for a decimal point. Snug must answer each one by

* error: one line that contains the place,
* list: parts of the model that are not translated,
* no solution: the message of a state that has none,
* warning: a warning that the deck without the change does not have,
* same model: the displacements of the deck without the change, where CalculiX has these as well
  or does not run the deck,
* model of the changed deck: displacements that change as those of CalculiX do.

Any other model is wrong in silence. Displacements are compared instead of parameter files, because
a parameter file takes the mesh from the deck. CalculiX does not read the deck of Abaqus/CAE: its
model must not change without a warning."""

import argparse
import collections
import concurrent.futures
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"
sys.path.append(str(LIBRARY))

from calculix import require_ccx  # noqa: E402
from deck_files import bolts, compare, contacts, mutations, single_bodies  # noqa: E402
from deck_files.model import Probe  # noqa: E402
from runs import environment  # noqa: E402

SEED, PER_DECK = 311, 10
# Differences from the change of displacements by CalculiX: parts of the displacements of the deck
# without the change, and of the change
BOUND, PART = .005, .25
EQUAL = 1e-6  # relative difference of displacements that shows the same model
EXAMPLES = [contacts.prepomax_adjusted, contacts.prepomax_hot_bar, single_bodies.freecad_wedges,
            single_bodies.mecway_oblique, single_bodies.mecway_quarter_ring,
            single_bodies.cgx_ring, single_bodies.cgx_dam, bolts.prepomax_tightened_bar]

# displacements: of the points in all steps, or None; kind: of the answer, without a comparison;
# by_calculix: the displacements of CalculiX
Answer = collections.namedtuple("Answer", "kind message displacements warnings by_calculix",
                                defaults=[None, None, None])


class Blocks:
    """This class is a deck of tests/meshes with the points of comparison at its top."""

    probes = [Probe(n, 2) for n in (112, 114, 118)]
    places = {112: (2, 0, 2), 114: (1, 1, 2), 118: (2, 2, 2)}

    def position(self, node):
        return self.places[node]


def bases(meshes):
    """Return (name, files, model) of the decks."""
    for name in ("cae-blocks", "ccx-blocks", "prepomax-blocks"):
        yield name, {"deck.inp": (meshes / f"{name}.inp").read_text()}, Blocks()
    for function in EXAMPLES:
        example = function()
        yield function.__name__, example.ccx or example.files, example.model


def without_places(text):
    """Return a warning without numbers of lines, other numbers and the folders of files."""
    return re.sub(r"/\S*/|[(, ]*lines? [\d, and.]+( \(\d+ lines\))?\)?|\d+", "#", text)


def mutations_of(base, rng):
    """Return different mutations of a deck."""
    result = {}
    while len(result) < PER_DECK:
        found = mutations.mutate(base[1], rng.choice(list(mutations.CHANGES)), rng)
        if found:
            result[found.file, found.line, found.text] = found
    return list(result.values())


def ask_snug(snug, deck, model):
    """Return the Answer of Snug to a deck."""
    output = deck.parent / "out"
    sets = [word for entry in [*compare.EXACT, *compare.responses(model)]
            for word in ("--set", entry)]
    done = subprocess.run([snug, deck.name, "--output", output, *sets], cwd=deck.parent, text=True,
                          env=environment(), check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, errors="replace")
    errors = done.stderr.splitlines()
    message = errors[-1] if errors else ""
    if done.returncode == 0:
        summary = json.loads((output / "summary.json").read_text())
        warnings = collections.Counter(map(without_places, summary.get("warnings", [])))
        return Answer("", message, compare.displacements(summary, model), warnings)
    if done.returncode == 3:
        return Answer("no solution", message)
    if done.returncode == 2 and "not translated" in done.stdout:
        return Answer("list", done.stdout.splitlines()[0])
    has_place = re.search(r"line \d+|'[^']+'", message.partition("deck.inp")[2])
    is_error = done.returncode == 2 and len(errors) == 1 and has_place
    return Answer("error" if is_error else "UNCLEAR", done.stderr)


def ask_calculix(deck, model):
    """Return the displacements that CalculiX finds, or None."""
    try:
        text = deck.read_text()
        deck.write_text(re.sub(r"(?i), *(solver *= *pa\w+|nlgeom)", "", text))
        return compare.by_calculix(deck, model)
    except (compare.DeckError, KeyError, FileNotFoundError):
        return None


def ask_both(snug, folder, base):
    """Return the Answer to a deck without a change."""
    name, files, model = base
    answer = ask_snug(snug, compare.write(files, folder / "snug"), model)
    assert not answer.kind, (name, answer)
    by_calculix = ask_calculix(compare.write(files, folder / "ccx"), model)
    assert (by_calculix is None) == name.startswith("cae"), name
    return answer._replace(by_calculix=by_calculix)


def change(now, before):
    """Return the changes of all displacements."""
    return [a - b for one, other in zip(now, before) for a, b in zip(one, other)]


def is_same(now, before):
    """Return whether the displacements of two models are equal."""
    scale = max(abs(b) for other in before for b in other)
    return len(now) == len(before) and max(map(abs, change(now, before))) <= EQUAL * scale


def agree(found, base, expected):
    """Return whether Snug and CalculiX change the displacements by the same amounts. Differences of
    the elements and of the penalty are in both decks of a program."""
    if len(found.displacements) != len(expected):
        return False
    scale = max(abs(b) for other in base.by_calculix for b in other)
    by_calculix = change(expected, base.by_calculix)
    wrong = max(abs(a - b) for a, b in zip(change(found.displacements, base.displacements),
                                           by_calculix))
    return wrong <= BOUND * scale + PART * max(map(abs, by_calculix))


def judge(found, base, expected):
    """Return the kind of an answer with displacements."""
    if found.warnings - base.warnings:
        return "warning"
    same = is_same(found.displacements, base.displacements)
    if expected is None:
        return "same model" if same else "SILENT"
    if agree(found, base, expected):
        return "same model" if same else "model of the changed deck"
    return "SILENT"


def is_of_calculix(mutation):
    """Return whether a change has an effect in CalculiX alone: on its output or its penalty, or by
    members of sets that are listed twice, which CalculiX loads twice."""
    return (mutation.keyword in ("NODE FILE", "EL FILE", "SURFACE BEHAVIOR") and
            "data" in mutation.kind or mutation.kind == "comma for point" and
            mutation.keyword == "SURFACE BEHAVIOR" or
            mutation.keyword in ("NSET", "ELSET") and mutation.kind == "data line doubled")


def examine(snug, folder, base, mutation):
    """Return (kind, text) of the answer to a mutation."""
    name, _, model, of_base = base
    found = ask_snug(snug, compare.write(mutation.files, folder / "snug"), model)
    expected, kind = None, found.kind
    if not kind and of_base.by_calculix:
        expected = of_base.by_calculix if is_of_calculix(mutation) else ask_calculix(
            compare.write(mutation.files, folder / "ccx"), model)
    if not kind:
        kind = judge(found, of_base, expected)
    text = (f"{kind}: {name}, {mutation.kind}, {mutation.file} line {mutation.line}: "
            f"{mutation.text}\n  {found.message.strip()}")
    if found.displacements:
        text += (f"\n  Snug {found.displacements}\n  CalculiX {expected}\n"
                 f"  before {of_base.displacements}\n  new warnings "
                 f"{list(found.warnings - of_base.warnings)}")
    return kind, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("snug", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("--show", action="store_true", help="print all answers")
    parser.add_argument("--seed", type=int, default=SEED)
    options = parser.parse_args()
    require_ccx()
    rng, snug, counts, wrong = random.Random(options.seed), options.snug.resolve(), {}, 0
    with tempfile.TemporaryDirectory() as temporary, \
            concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder, jobs = pathlib.Path(temporary), []
        decks = list(bases(options.meshes))
        answers = pool.map(lambda base: ask_both(snug, folder / base[0], base), decks)
        for base, of_base in zip(decks, list(answers)):
            for i, mutation in enumerate(mutations_of(base, rng)):
                jobs.append((snug, folder / f"{base[0]}-{i}", (*base, of_base), mutation))
        for kind, text in pool.map(lambda job: examine(*job), jobs):
            counts[kind] = counts.get(kind, 0) + 1
            wrong += kind.isupper()
            if options.show or kind.isupper():
                print(text, flush=True)
    print(", ".join(f"{kind}: {n}" for kind, n in sorted(counts.items())))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
