#!/usr/bin/env python3
"""Ties of decks: deck_ties.py SNUG MESHES --mpiexec MPIEXEC.

A deck with *TIE has the state of a parameter file with this law. Written decks with tied pairs are
read back to the same state, and CalculiX finds their largest displacement."""

import argparse
import math
import pathlib
import sys
import tempfile

from decks import BLOCKS, EXACT, PAIR, Runner, calculix
from calculix import require_ccx

# Two blocks with unlike meshes, of which only the tie holds the upper one
TIED = ["Contact/Law=tied", "Body upper/Supports=", "Body upper/Pressure=top: 10, left: 5",
        "Body upper/Box cells=3, 3, 1", "Output/Meshes=inp"]
VARIANTS = {"any gap": [], "a gap": ["Body upper/Box corner=0, 0, 1.1"],
            "a distance": ["Contact/Search distance=0.01"],
            "several faces": ["Contact/Pairs=lower.top + lower.left: upper.bottom + upper.left",
                              "Contact/Search distance=0.01"]}
NAMES = ("energy", "compliance")
# Cells of the upper block, and bounds of the differences of the largest displacement. CalculiX ties
# each slave node to a point of the master side, which differs from Snug's tie where nodes do not
# match.
CALCULIX = {"2, 2, 1": 1e-5, "3, 3, 1": 0.02}


def check_reading(runner, scene, meshes):
    deck = runner.folder / "tie.inp"
    deck.write_text((meshes / "ccx-blocks.inp").read_text().replace(
        PAIR, "*TIE, NAME=T\nSSLAVE, SMASTER"))
    expected, _ = runner.summary("tied", scene, *EXACT, "Contact/Law=tied")
    found, _ = runner.summary("tie.inp.out", deck, *EXACT, ranks=2)
    runner.compare("tie of a deck", found, expected, 1e-9, NAMES)


def check_read_back(runner, scene):
    for title, entries in VARIANTS.items():
        expected, output = runner.summary(title, scene, *EXACT, *TIED, *entries)
        found, _ = runner.summary(title + ".read", output / "bodies.inp", *EXACT, ranks=2)
        runner.compare(f"tied across {title}, read back", found, expected, 1e-9, NAMES)


def check_calculix(runner, scene):
    for cells, bound in CALCULIX.items():
        tied, output = runner.summary(cells, scene, *EXACT, *TIED, f"Body upper/Box cells={cells}")
        displacement, _ = calculix(runner, f"tied {cells}", output)
        largest = max(math.hypot(*u[:3]) for u in displacement.values())
        error = largest / tied["state"]["max_displacement"] - 1
        runner.require(f"tied {cells} by CalculiX", abs(error) < bound, f"error {error:.2e}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("snug", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("--mpiexec", default="mpirun")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(options.snug.resolve(), options.mpiexec, pathlib.Path(folder))
        scene = runner.folder / "blocks.prm"
        scene.write_text(BLOCKS)
        check_reading(runner, scene, options.meshes)
        check_read_back(runner, scene)
        if not runner.wrong:
            require_ccx()
            check_calculix(runner, scene)
    print("\n".join(runner.wrong) or "all right")
    return bool(runner.wrong)


if __name__ == "__main__":
    sys.exit(main())
