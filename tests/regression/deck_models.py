#!/usr/bin/env python3
"""Compare decks of five pre-processors with CalculiX: deck_models.py SNUG [--folder DIR] [NAME...].

Decks in the manner of Abaqus/CAE, PrePoMax, FreeCAD, cgx and Mecway are generated and run by
Snug and by CalculiX. The largest difference of the displacements at some nodes in all steps, over
the largest of these displacements, must be below the bound of the deck, which is 1 % unless the
deck states a reason. CalculiX gets parts, instances and general contact as a deck of nodes,
elements and contact pairs, which is generated from the same model."""

import argparse
import concurrent.futures
import pathlib
import sys
import tempfile

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"
sys.path.append(str(LIBRARY))

from calculix import require_ccx  # noqa: E402
from deck_files import bolts, compare, contacts, couplings, single_bodies, ties  # noqa: E402


def examples():
    """Return {name: function} of all decks."""
    return {name: function for module in (single_bodies, contacts, ties, couplings, bolts)
            for name, function in vars(module).items()
            if name.partition("_")[0] in ("cae", "prepomax", "freecad", "cgx", "mecway")}


def measure(snug, name, folder):
    """Return (name, difference, bound, message)."""
    example = examples()[name]()
    try:
        found, snug_values, ccx_values = compare.compare(snug, example, folder / name)
    except compare.DeckError as error:
        return name, float("inf"), example.bound, str(error)
    lines = [f"  step {i + 1}, {program}: " + " ".join(f"{value:.6g}" for value in values)
             for i, pair in enumerate(zip(snug_values, ccx_values))
             for program, values in zip(("Snug", "CalculiX"), pair)]
    return name, found, example.bound, "\n".join(lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("snug", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--folder", type=pathlib.Path, help="where the decks stay")
    options = parser.parse_args()
    require_ccx()
    wrong = 0
    with tempfile.TemporaryDirectory() as temporary, \
            concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder = options.folder or pathlib.Path(temporary)
        for name, found, bound, message in pool.map(
                lambda name: measure(options.snug.resolve(), name, folder.resolve()),
                options.names or examples()):
            print(f"{name}: {100. * found:.3f} %, bound {100. * bound:g} %", flush=True)
            if not found <= bound:
                wrong += 1
                print(message)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
