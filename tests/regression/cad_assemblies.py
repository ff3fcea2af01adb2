#!/usr/bin/env python3
"""CAD files with several solids as parameter files: cad_assemblies.py SNUG.

The program gmsh makes assemblies as STEP files. The parameter file that 'snug --translate' prints is
valid without an edit, names the bodies like the products, and has the contact pairs of the assembly.
With supports and loads as only additions it is solved, and contact forces are known. A gmsh that takes
more than a second has a line in the log, except in quiet runs. A CAD file that is to be run is
refused."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"))

from runs import sample  # noqa: E402

DOVETAIL = """
Point(1) = {-10, 0, 0}; Point(2) = {10, 0, 0}; Point(3) = {10, 10, 0}; Point(4) = {4, 10, 0};
Point(5) = {6, 4, 0}; Point(6) = {-6, 4, 0}; Point(7) = {-4, 10, 0}; Point(8) = {-10, 10, 0};
Point(9) = {-4, 20, 0}; Point(10) = {4, 20, 0};
For i In {1:7}
  Line(i) = {i, i + 1};
EndFor
Line(8) = {8, 1}; Line(9) = {7, 9}; Line(10) = {9, 10}; Line(11) = {10, 4};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, 9, 10, 11}; Plane Surface(2) = {2};
Extrude {0, 0, 8} { Surface{1}; }
Extrude {0, 0, 8} { Surface{2}; }
Recursive Delete { Surface{1, 2}; }
"""
PRESS_FIT = """
Cylinder(1) = {0, 0, 0, 0, 0, 10, 10.02, Pi/2};
Cylinder(2) = {0, 0, 0, 0, 0, 10, 20, Pi/2};
Cylinder(3) = {0, 0, 0, 0, 0, 10, 10, Pi/2};
BooleanDifference{ Volume{2}; Delete; }{ Volume{3}; Delete; }
"""
CAM = """
a = 12; b = 8;
Point(1) = {0, 0, 0}; Point(2) = {a, 0, 0}; Point(3) = {0, b, 0}; Point(4) = {-a, 0, 0};
Ellipse(1) = {2, 1, 2, 3}; Ellipse(2) = {3, 1, 2, 4}; Line(3) = {4, 2};
Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
Extrude {0, 0, 5} { Surface{1}; }
Recursive Delete { Surface{1}; }
Box(2) = {-8, b, 0, 16, 4, 5};
"""
PIN_AND_CLEVIS = """
Box(1) = {-8, -20, -10, 16, 20, 6}; Box(2) = {-8, -20, 4, 16, 20, 6};
Box(3) = {-8, -26, -10, 16, 6, 20};
Cylinder(4) = {0, 0, -10, 0, 0, 6, 8}; Cylinder(5) = {0, 0, 4, 0, 0, 6, 8};
BooleanUnion(6) = { Volume{1}; Delete; }{ Volume{2:5}; Delete; };
Cylinder(7) = {0, 0, -11, 0, 0, 22, 4};
BooleanDifference(8) = { Volume{6}; Delete; }{ Volume{7}; Delete; };
Cylinder(9) = {0, 0, -3.9, 0, 0, 7.8, 8}; Box(10) = {-8, 0, -3.9, 16, 24, 7.8};
BooleanUnion(11) = { Volume{9}; Delete; }{ Volume{10}; Delete; };
Cylinder(12) = {0, 0, -4, 0, 0, 8, 4};
BooleanDifference(13) = { Volume{11}; Delete; }{ Volume{12}; Delete; };
Cylinder(14) = {0, 0, -11, 0, 0, 22, 3.98};
"""
BEARING = """
Cylinder(1) = {0, 0, 0, 0, 0, 8, 25, Pi/2}; Cylinder(2) = {0, 0, 0, 0, 0, 8, 18, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, 0, 0, 0, 8, 40, Pi/2}; Cylinder(5) = {0, 0, 0, 0, 0, 8, 33, Pi/2};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
For i In {0:2}
  t = Pi/12 + i*Pi/6;
  Cylinder(7 + i) = {29*Cos(t), 29*Sin(t), 0, 0, 0, 8, 4};
EndFor
"""
FLANGE = """
Box(1) = {0, 0, 0, 30, 15, 6}; Box(2) = {0, 0, 6, 30, 15, 6};
Cylinder(3) = {20, 0, -1, 0, 0, 20, 4.4};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{3}; };
BooleanDifference(5) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
Cylinder(6) = {20, 0, 0, 0, 0, 12, 4}; Cylinder(7) = {20, 0, 12, 0, 0, 4, 7};
Cylinder(8) = {20, 0, -4, 0, 0, 4, 7};
BooleanUnion(9) = { Volume{6}; Delete; }{ Volume{7, 8}; Delete; };
Box(10) = {0, -20, -10, 40, 20, 40};
BooleanDifference(11) = { Volume{9}; Delete; }{ Volume{10}; Delete; };
"""
# name: (script, products, pairs of bodies, {entry: {text: value}}). The value is that of the faces of
# the body of the entry with the text in the list of faces: all faces at x = 0 for "x 0".
ASSEMBLIES = {
    "press-fit": (PRESS_FIT, ["shaft", "hub"], ["shaft hub"],
                  {f"Body {body}/Supports": {"x 0": "x", "y 0": "y", "z 0": "z"}
                   for body in ("shaft", "hub")}),
    "pin-and-clevis": (PIN_AND_CLEVIS, ["clevis", "eye", "pin"],
                       ["clevis eye", "clevis pin", "eye pin"],
                       {"Body clevis/Supports": {"y -26": "xyz"},
                        "Body eye/Supports": {"y 24": "xz"},
                        "Body eye/Pressure": {"y 24": "-10"},
                        "Body pin/Springs": {"z -11": "xyz = 10"}}),
    "dovetail": (DOVETAIL, ["groove", "tongue"], ["groove tongue"],
                 {"Body groove/Supports": {"y 0": "xyz"},
                  "Body tongue/Pressure": {"y 20": "-10"}}),
    "bearing": (BEARING, ["inner", "outer", "roller", "roller", "roller"],
                [f"{ring} roller{k}" for ring in ("inner", "outer") for k in ("", "-2", "-3")],
                {"Body inner/Supports": {"cylinder of radius 18": "xyz"},
                 "Body outer/Supports": {"x 0": "x", "y 0": "y", "z 0": "z"},
                 "Body outer/Pressure": {"cylinder of radius 40": "100"},
                 **{f"Body roller{k}/Springs": {"z 8": "xyz = 10"} for k in ("", "-2", "-3")}}),
    "cam": (CAM, ["cam", "follower"], ["cam follower"],
            {"Body cam/Supports": {"y 0": "xyz"}, "Body follower/Supports": {"y 12": "xz"},
             "Body follower/Pressure": {"y 12": "5"}}),
    "flange": (FLANGE, ["lower", "upper", "bolt"], ["lower upper", "lower bolt", "upper bolt"],
               {"Body lower/Supports": {"y 0": "y", "x 0": "xz"},
                "Body upper/Supports": {"y 0": "y", "x 0": "x"},
                "Body upper/Traction": {"x 30": "0 0 5"},
                "Body bolt/Supports": {"y 0": "y"}}),
}
# Component and sum of the contact forces of an assembly, with its relative tolerance: p A of the
# dovetail and the cam, and of the quarter of the press fit p r L with the pressure
# p = E d (1 - r^2 / R^2) / (2 r) of the overlap d = 0.02 (Lame)
FORCES = {"dovetail": (1, 640., 1e-6), "cam": (1, 400., 1e-6), "press-fit": (0, 15750., 0.02)}


def run(command, folder, status=0, **options):
    """The output of a command in a folder, which ends with this status."""
    done = subprocess.run([str(word) for word in command], cwd=folder, text=True, timeout=600,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, **options)
    if done.returncode != status:
        raise SystemExit(f"{command} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def make_step(name, script, products, folder):
    """A STEP file whose solids are these products. Gmsh itself does not name products."""
    (folder / f"{name}.geo").write_text(
        f'SetFactory("OpenCASCADE");\n{script}\nSave "{name}.step";\n', encoding="utf-8")
    run(["gmsh", "-0", f"{name}.geo"], folder)
    path = folder / f"{name}.step"
    text = path.read_text(encoding="utf-8")
    of_gmsh = r"'Open CASCADE STEP translator [\d.]+ 1\.%d'"
    for k, product in enumerate(products, 1):
        text, n = re.subn(of_gmsh % k, f"'{product}'", text)
        if n == 0:
            raise SystemExit(f"{name}: there is no product {k}")
    path.write_text(text, encoding="utf-8")


def faces(listed, body, text):
    """The names of the faces of a body with this text in the list of '--validate'."""
    own = re.search(rf"^body {body}, .*:\n((  face .*\n)+)", listed, re.MULTILINE)[1]
    found = [row.split()[2] for row in own.splitlines()
             if re.search(re.escape(text) + r"(?! to|\d|\.)", row)]
    if not found:
        raise SystemExit(f"{body}: no face has '{text}' in\n{own}")
    return found


def check_assembly(snug, name, folder):
    """The parameter file of an assembly: its bodies and pairs, and the contact forces."""
    script, products, pairs, entries = ASSEMBLIES[name]
    make_step(name, script, products, folder)
    text = run([snug, "--translate", f"{name}.step"], folder)
    (folder / f"{name}.prm").write_text(text, encoding="utf-8")
    bodies = re.search(r"set Bodies = (.*)", text)[1].split(", ")
    if [re.sub(r"-\d$", "", body) for body in bodies] != products:
        raise SystemExit(f"{name}: the bodies are {bodies}")
    found = {" ".join(side.split(".")[0] for side in pair.split(": "))
             for pair in re.search(r"set Pairs = (.*)", text)[1].split(", ")}
    if found != set(pairs):
        raise SystemExit(f"{name}: the pairs are {found}")
    listed = run([snug, "--validate", f"{name}.prm"], folder)
    sets = []
    for entry, of_faces in entries.items():
        body = entry.partition("/")[0].removeprefix("Body ")
        value = ", ".join(f"{face}: {own}" for text, own in of_faces.items()
                          for face in faces(listed, body, text))
        sets += ["--set", f"{entry}={value}"]
    run([snug, f"{name}.prm", *sets, "--output", name], folder)
    state = json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))["state"]
    if state["active_contacts"] == 0:
        raise SystemExit(f"{name}: no contact is active")
    if name in FORCES:
        component, force, tolerance = FORCES[name]
        if abs(abs(state["contact_force"][component]) - force) > tolerance * force:
            raise SystemExit(f"{name}: the contact force is {state['contact_force']}, not {force}")
    print(f"{name}: contact force {state['contact_force']}")


def check_log(snug, folder):
    """A line for a gmsh that takes more than a second, except in quiet runs."""
    slow = folder / "slow"
    slow.mkdir()
    (slow / "gmsh").write_text(f'#!/bin/sh\nsleep 1.1\nexec {shutil.which("gmsh")} "$@"\n',
                               encoding="utf-8")
    (slow / "gmsh").chmod(0o755)
    env = {**os.environ, "PATH": f"{slow}:{os.environ['PATH']}"}
    for verbosity, expected in (("normal", True), ("quiet", False)):
        log = run([snug, "--validate", "cam.prm", "--set", f"Output/Verbosity={verbosity}"],
                  folder, env=env)
        if bool(re.search(r"^cam\.step, mesh by gmsh: \d[\d.]* s$", log, re.MULTILINE)) != expected:
            raise SystemExit(f"{verbosity} log of a slow gmsh:\n{log}")


def check_refused(snug, folder):
    """A CAD file that is to be run, and one without a solid."""
    message = run([snug, "cam.step"], folder, status=2)
    if "snug --translate cam.step" not in message:
        raise SystemExit(f"CAD file to be run: {message}")
    (folder / "empty.step").write_text("no part\n", encoding="utf-8")
    message = run([snug, "--translate", "empty.step"], folder, status=2)
    if "snug: empty.step: is not a STEP file" not in message:
        raise SystemExit(f"damaged CAD file: {message}")


def main():
    snug = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name in sample(ASSEMBLIES):  # every second one takes seconds
            check_assembly(snug, name, folder)
        check_log(snug, folder)
        check_refused(snug, folder)


if __name__ == "__main__":
    sys.exit(main())
