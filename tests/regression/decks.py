#!/usr/bin/env python3
"""Decks of Abaqus and CalculiX, read and written: decks.py SNUG MESHES --mpiexec MPIEXEC [--calculix].

Decks of two blocks in the styles of three pre-processors have the state of a parameter file with
boxes. What they contain beyond it is listed with its lines, and each kind of damage is one line. The
files of a designed scene are read back to the same state. With --calculix, CalculiX alone solves
written decks: it finds their displacements and contact pressures as far as its penalty and its
elements allow."""

import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "contrib/lib"
sys.path += [str(LIBRARY), str(LIBRARY / "stability")]

from calculix import field, require_ccx  # noqa: E402
from many import run_many  # noqa: E402

BLOCKS = """
set Bodies = lower, upper
subsection Body lower
  set Box size = 2, 2, 1
  set Box cells = 2, 2, 1
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Supports = bottom: xyz
end
subsection Body upper
  set Box size = 2, 2, 1
  set Box corner = 0, 0, 1
  set Box cells = 2, 2, 1
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Supports = top: xy
  set Pressure = top: 10
end
subsection Contact
  set Pairs = lower.top: upper.bottom
  set Slave = first
  set Friction = Coulomb
  set Friction coefficient = 0.1
end
"""
# Measured difference of the peak pressures of the designed punch
PEAK = 0.03
EXACT = ["Solver/Relative tolerance=1e-12", "Accuracy/Estimate=none"]
# Forces of the deck of check_forces(), which has more of them at nodes that are held
FORCES = "Body upper/Point force=top: 0 0 -7 at 2 2 2, top: 0 0 2 at 2 0 2, top: 0 0 -1 at 0 0 2"
# What the decks contain beyond the parameter file, with the lines
REMARKS = {
    "cae-blocks.inp": ["# Not needed: *FRICTION: SLIPTOLERANCE (line 90)",
                       "*OUTPUT (lines 126 and 127)"],
    "ccx-blocks.inp": ["hard contact instead of *SURFACE BEHAVIOR LINEAR (line 66)",
                       "small displacements instead of NLGEOM (line 83)",
                       "# Not needed: *NODE FILE (line 91)"],
    "prepomax-blocks.inp": ["point supports for nodes of *BOUNDARY", "(line 136)",
                            "*NODE FILE (line 148)"]}
# The node that the deck of PrePoMax holds beside the faces
HELD = "Body upper/Point supports=bottom: x at 0 0 1"
# Parts of the model without a translation, in place of '*NODE FILE' or of the contact pair of
# ccx-blocks.inp, with the kinds and the words of the list
PAIR = "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nSSLAVE, SMASTER"
LACKING = [
    ("*NODE FILE\nU", "*DLOAD\nEALL, CENTRIF, 1., 0., 0., 0., 0., 0., 1.", "dload", ["'CENTRIF'"]),
    ("*NODE FILE\nU", "*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nELOW", "model change", ["(line 91)"]),
    ("*NODE FILE\nU", "*END STEP\n*STEP\n*FREQUENCY\n3", "frequency", ["*FREQUENCY (line 93)"]),
    ("*NODE FILE\nU", "*BOUNDARY\nNFIX, 11, 11, 5.", "boundary", ["other than 1 to 6"]),
    ("*NODE FILE\nU", "*CLOADS\nNFIX, 3, 5.", "cloads", ["*CLOADS (line 91)"]),
    (PAIR, PAIR + "\n*TIE, NAME=T, MULTISTAGE\nSSLAVE, SMASTER", "tie", ["option MULTISTAGE"]),
    (PAIR, PAIR + "\n*EQUATION\n2\n1,1,1.,2,1,-1.", "equation", ["*EQUATION"]),
    (PAIR, PAIR + "\n*RIGID BODY, NSET=NFIX, REF NODE=1", "rigid body", ["*RIGID BODY"]),
    (PAIR, PAIR + "\n*NODE\n900, 0., 0., 9.\n*COUPLING, REF NODE=900, SURFACE=SSLAVE\n*KINEMATIC\n3",
     "kinematic", ["*KINEMATIC of some components only"]),
    (PAIR, PAIR + "\n*ELEMENT, TYPE=B31, ELSET=BEAM\n901, 1, 2", "element", ["of type B31"]),
    (PAIR, PAIR + "\n*BEAM SECTION, ELSET=ELOW, MATERIAL=EL\n1., 1.", "beam section", ["*BEAM"]),
    ("*ELASTIC\n1000, .3", "*ELASTIC\n1000, .3\n*PLASTIC\n5., 0.", "plastic", ["*PLASTIC"])]
# A punch whose bottom is designed, on a flat block, at both of which nodes match. The rows have the
# normal of the flat master side, so that the true surface between the nodes does not matter.
PUNCH_ON_BASE = """
set Bodies = punch, base
subsection Body punch
{punch}
  set Young's modulus = 2000
  set Poisson's ratio = 0.3
  set Supports = left: x, right: x, front: y, back: y
  set Pressure = top: 20
end
subsection Body base
{base}
  set Young's modulus = 1000
  set Poisson's ratio = 0.25
  set Supports = bottom: xyz
end
subsection Contact
  set Pairs = punch.bottom: base.top
  set Slave = first
end
"""
DESIGNED = PUNCH_ON_BASE.format(punch="  set Box corner = 0, 0, 1\n  set Box cells = 4, 4, 2",
                                base="  set Box cells = 4, 4, 2") + """
set Task = optimize
subsection Shape
  set Basis = Bezier patch
  set Face = punch.bottom
  set Control points = 3, 3
  set Bounds = -0.05, 0.05
  set Initial = 0.02, 0, 0, 0, -0.02, 0, 0, 0, 0
end
subsection Optimization
  set Maximum evaluations = 3
end
subsection Output
  set Meshes = msh, inp
end
"""
FACES = ("left", "right", "front", "back", "bottom", "top")
# Damage of ccx-blocks.inp, and words of the message
WRONG = [
    ("*NSET, NSET=NFIX, GENERATE\n1,9", "*NSET, NSET=NFIX\n1,x", ["line 49", "'x'", "neither a set"]),
    ("*NSET, NSET=NFIX, GENERATE\n1,9", "*NSET, NSET=NFIX\n1,99", ["the node 99"]),
    ("NSET=NFIX, GENERATE", "NSET=NFIX, INSTANCE=a, GENERATE", ["no instance 'a'"]),
    ("ELOW, S2", "ELOW, S7", ["has no face 'S7'"]),
    ("SSLAVE, SMASTER\n*BOUND", "SSLAVE, SMISSING\n*BOUND", ["no surface 'SMISSING'"]),
    ("*MATERIAL, NAME=EL\n", "*MATERIAL, NAME=XX\n", ["no *MATERIAL 'EL'"]),
    ("*ELASTIC\n1000, .3", "*ELASTIC, TYPE=ORTHO\n1000, .3", ["has no isotropic *ELASTIC"]),
    ("*ELASTIC\n1000, .3", "*ELASTIC\n1000", ["a modulus and a ratio"]),
    ("*ELASTIC\n1000, .3", "*ELASTIC\n1000, 0.7", ["Poisson's ratio", "0.7"]),
    ("*SOLID SECTION, ELSET=EALL", "*SOLID SECTION, ELSET=ELOW", ["has no material"]),
    ("*SOLID SECTION, ELSET=EALL", "*SOLID SECTION, ELSET=EXX", ["'EXX'", "neither a set"]),
    ("NFIX,1,3", "NFIX", ["a set and its components"]),
    ("NFIX,1,3", "NXXX,1,3", ["NXXX"]),
    ("NFIX,1,3", "NFIX,one,3", ["'one'"]),
    ("11,P2,10.", "11,P9,10.", ["has no face 'P9'"]),
    ("11,P2,10.", "11,P2,ten", ["'ten' is not a number"]),
    ("*NODE FILE\nU", "*CLOAD\nNFIX,3", ["line 92", "a node or set, a component and a force"]),
    ("*NODE FILE\nU", "*CLOAD\nNXXX,3,1", ["line 92", "'NXXX'", "neither a set"]),
    ("*NODE FILE\nU", "*CLOAD\n999,3,1", ["line 92", "the node 999"]),
    ("*NODE FILE\nU", "*CLOAD\n118,z,1", ["line 92", "'z'"]),
    ("*NODE FILE\nU", "*CLOAD\n118,3,one", ["line 92", "'one' is not a number"]),
    ("** two blocks", "two blocks", ["a deck of Abaqus"]),
    ("*ELEMENT, TYPE=C3D8", "*ELEMENT, TYPE=C3D9", ["element type 'C3D9'"]),
    ("*STEP, NLGEOM", "*INCLUDE, INPUT=more.inp\n*STEP", ["more.inp"]),
    ("*STEP, NLGEOM", "*COUPLING, REF NODE=1\n*KINEMATIC\n*STEP", ["must have a SURFACE"]),
    ("*STEP, NLGEOM", "*DISTRIBUTING\n*STEP", ["*DISTRIBUTING must follow *COUPLING"]),
    ("*NODE, NSET=NALL", "*INSTANCE, NAME=a, PART=b\n*NODE, NSET=NALL", ["has no *END"]),
    ("*NODE, NSET=NALL", "*PART, NAME=b\n*PART, NAME=c\n*NODE, NSET=NALL", ["more than one part"])]


class Runner:
    def __init__(self, snug, mpiexec, folder):
        self.snug, self.mpiexec, self.folder, self.wrong = snug, mpiexec, folder, []

    def run(self, *words, ranks=1):
        command = [self.mpiexec, "-np", ranks] if ranks > 1 else []
        return subprocess.run([str(word) for word in [*command, self.snug, *words]], text=True,
                              check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def summary(self, title, scene, *sets, ranks=1):
        """Run a scene and return its summary and its output directory."""
        output = self.folder / title
        done = self.run(scene, "--output", output,
                        *(word for entry in sets for word in ("--set", entry)), ranks=ranks)
        if not (output / "summary.json").exists():
            raise SystemExit(f"{title}: {done.stdout}")
        return json.loads((output / "summary.json").read_text()), output

    def require(self, title, good, message=""):
        print(f"{title}: {'good' if good else 'WRONG'} {message}")
        if not good:
            self.wrong.append(f"{title}: {message}")

    def compare(self, title, found, expected, tolerance,
                names=("energy", "compliance", "max_pressure", "contact_area")):
        state, other = found["state"], expected["state"]
        for name in names:
            error = abs(state[name] - other[name]) / abs(other[name])
            self.require(f"{title}, {name}", error <= tolerance, f"{state[name]} error {error:.1e}")


def check_decks(runner, meshes):
    scene = runner.folder / "blocks.prm"
    scene.write_text(BLOCKS)
    expected, _ = runner.summary("blocks", scene, *EXACT)
    held, _ = runner.summary("held", scene, *EXACT, HELD)
    for name, lines in REMARKS.items():
        of_deck = held if name.startswith("prepomax") else expected
        found, _ = runner.summary(name + ".out", meshes / name, *EXACT, ranks=2)
        runner.compare(name, found, of_deck, 1e-9)
        done = runner.run("--translate", meshes / name)
        runner.require(f"{name} lists what it changes",
                       done.returncode == 0 and all(line in done.stdout for line in lines),
                       done.stdout[:900])
        # The parameter file says the same beside the deck.
        shutil.copy(meshes / name, runner.folder)
        written = runner.folder / (name + ".prm")
        written.write_text(done.stdout)
        found, _ = runner.summary(name + ".prm.out", written, *EXACT)
        runner.compare(f"parameter file of {name}", found, of_deck, 1e-9)


def check_lacking_parts(runner, meshes):
    """A part of the model without a translation ends the run, unless its kind is accepted."""
    good = (meshes / "ccx-blocks.inp").read_text()
    for number, (old, new, kind, words) in enumerate(LACKING):
        assert old in good, old
        path = runner.folder / f"lacking-{number}.inp"
        path.write_text(good.replace(old, new, 1))
        done = runner.run(path, "--validate")
        runner.require(f"deck with {kind}", done.returncode == 2 and
                       f'--leave-out "{kind}"' in done.stdout and
                       all(word in done.stdout for word in ["not translated: *", *words]),
                       done.stdout[:400])
        done = runner.run(path, "--validate", "--leave-out", kind)
        runner.require(f"deck without {kind}", done.returncode == 0 and
                       f"left out: *{kind.upper()}" in done.stdout, done.stdout[:400])
    done = runner.run("--translate", path)
    runner.require("yield stress of *PLASTIC", done.returncode == 0 and
                   "set Yield stress = 5\n" in done.stdout, done.stdout[:2000])
    done = runner.run(path, "--validate", "--leave-out", "plastic, tie")
    runner.require("unknown kind", done.returncode == 2 and
                   "the deck has no 'tie'" in done.stdout, done.stdout)


def check_includes(runner, meshes):
    """The mesh of a deck in a file of its own, as CalculiX users have it; errors name the file."""
    good = (meshes / "ccx-blocks.inp").read_text()
    mesh, rest = good[:good.index("*NSET")], good[good.index("*NSET"):]
    scene = runner.folder / "split" / "model.inp"
    (scene.parent / "parts").mkdir(parents=True)
    scene.write_text("** model\n*include, input=parts/all.msh\n" + rest)
    (scene.parent / "parts" / "all.msh").write_text(mesh)
    expected, _ = runner.summary("whole", meshes / "ccx-blocks.inp", *EXACT)
    found, _ = runner.summary("split.out", scene, *EXACT, ranks=2)
    runner.compare("included mesh", found, expected, 1e-12)
    (scene.parent / "parts" / "all.msh").write_text(mesh.replace("1,0,0,0", "1,0,zero,0"))
    done = runner.run(scene)
    runner.require("error of an included file", done.returncode == 2 and
                   "'parts/all.msh', line 3: 'zero'" in done.stdout, done.stdout)
    (scene.parent / "parts" / "all.msh").write_text("*INCLUDE, INPUT=parts/all.msh\n")
    done = runner.run(scene)
    runner.require("files that include each other", done.returncode == 2 and
                   "more than 10 files" in done.stdout, done.stdout)


def check_forces(runner, meshes):
    """Forces at nodes, of which one has two: the entry of a parameter file, and of a written deck."""
    scene, deck = runner.folder / "blocks.prm", runner.folder / "forces.inp"
    deck.write_text((meshes / "ccx-blocks.inp").read_text().replace(
        "*NODE FILE\nU", "*CLOAD\n118, 3, -3\n112, 3, 2\n110, 3, -1\n118, 3, -4\nNFIX, 1, 3"))
    expected, _ = runner.summary("forces", scene, *EXACT, FORCES)
    found, _ = runner.summary("forces.inp.out", deck, *EXACT, ranks=2)
    runner.compare("forces at nodes", found, expected, 1e-12)
    for title, *entries in (("quadratic", "Element degree=2"),
                            ("written forces", "Body upper/Point force=top: 0 0 -7 at 1.3 0.6 2")):
        expected, output = runner.summary(title, scene, *EXACT, *entries, "Output/Meshes=inp")
        found, _ = runner.summary(title + ".read", output / "bodies.inp", *EXACT)
        runner.compare(f"{title}, read back", found, expected, 1e-9)
    _, output = runner.summary("warm", scene, "Output/Meshes=inp", "Body upper/Springs=top: z = 1",
                               "Body upper/Expansion=1e-3", "Body upper/Temperature=1")
    text = (output / "bodies.inp").read_text()
    for line in ("springs", "temperatures, instead of which it has the forces"):
        runner.require(f"a deck lacks {line}", f"** not in this deck: {line}" in text)


def check_wrong_decks(runner, meshes):
    good = (meshes / "ccx-blocks.inp").read_text()
    arguments = []
    for number, (old, new, words) in enumerate(WRONG):
        assert old in good, old
        path = runner.folder / f"wrong-{number}.inp"
        path.write_text(good.replace(old, new, 1))
        arguments.append(["--translate" if "a deck of Abaqus" in words else "--validate", str(path)])
    for number, end in enumerate(run_many(arguments)):
        runner.require(f"wrong deck {number}", end.status == 2 and end.lines == 1 and all(
            word in end.message for word in [f"wrong-{number}.inp", *WRONG[number][2]]),
            end.message[:300])


def check_node_numbers(runner, output):
    """The last contact table names the nodes of the written mesh at its positions."""
    mesh = (output / "bodies.msh").read_text().split("$Nodes\n")[1].split("$EndNodes")[0]
    nodes = {words[0]: [float(x) for x in words[1:]]
             for words in map(str.split, mesh.splitlines()[1:])}
    with open(sorted(output.glob("contact-*.csv"))[-1], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    runner.require(f"node numbers of {output.name}", len(rows) == 25 and all(
        abs(x - float(row[axis])) < 1e-8  # tables have nine digits
        for row in rows for x, axis in zip(nodes[row["node"]], "xyz")))


def design_punch(runner):
    """Return the path of the designed scene, its summary and its output directory."""
    scene = runner.folder / "designed.prm"
    scene.write_text(DESIGNED)
    return scene, *runner.summary("designed", scene, *EXACT)


def check_read_back(runner):
    scene, designed, output = design_punch(runner)
    for ending in ("msh", "inp"):
        path = runner.folder / f"read-{ending}.prm"
        path.write_text(PUNCH_ON_BASE.format(**{
            body: f"  set Mesh = file\n  set File = {output}/bodies.{ending}\n"
                  f"  set Mesh regions = {body}\n  set Boundary names = " +
                  ", ".join(f"{body}.{face}: {face}" for face in FACES)
            for body in ("punch", "base")}))
        found, _ = runner.summary(f"read-{ending}", path, *EXACT)
        runner.compare(f"bodies.{ending} read back", found, designed, 1e-9)
    found, _ = runner.summary("read-deck", output / "bodies.inp", *EXACT)
    runner.compare("bodies.inp as a model", found, designed, 1e-9)
    # The files do not depend on the ranks.
    _, other = runner.summary("ranks", scene, *EXACT, "Task=state", ranks=3)
    _, one = runner.summary("rank", scene, *EXACT, "Task=state")
    for ending in ("msh", "inp"):
        runner.require(f"bodies.{ending} on 3 ranks",
                       (other / f"bodies.{ending}").read_text() ==
                       (one / f"bodies.{ending}").read_text())
    for folder in (output, other):
        check_node_numbers(runner, folder)


def calculix(runner, title, output):
    """Solve a written deck by CalculiX. Return its displacements and its contact pressures."""
    folder = runner.folder / title
    folder.mkdir()
    shutil.copy(output / "bodies.inp", folder / "bodies.inp")
    done = subprocess.run(["ccx", "bodies"], cwd=folder, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    runner.require(f"CalculiX solves {title}", done.returncode == 0 and
                   "Job finished" in done.stdout, done.stdout[-500:])
    displacement = field(folder / "bodies.frd", "DISP")
    pressure = {node: values[3] for node, values in
                field(folder / "bodies.frd", "CONTACT").items()}
    return displacement, pressure


def check_calculix(runner, scenes):
    """A uniform pressure is exact up to the penetration p h / 100 E, which 'Meshes' documents. The
    peaks of a designed punch differ by the elements C3D8, which are selectively reduced."""
    _, uniform = runner.summary("uniform", scenes / "deck-blocks.prm", *EXACT)
    displacement, pressure = calculix(runner, "uniform pressure", uniform)
    answer = -10 * (2 / (1000 * .7 / (1.3 * .4)) + 1 / (100 * 1000))
    found = min(u[2] for u in displacement.values())
    runner.require("shortening by CalculiX", abs(found / answer - 1) < 1e-4, f"{found} {answer}")
    slave = [p for p in pressure.values() if p > 0.]
    runner.require("uniform pressure by CalculiX", bool(slave) and max(
        abs(p - 10) for p in slave) < 1e-3, str(slave))
    _, designed, output = design_punch(runner)
    displacement, pressure = calculix(runner, "designed punch", output)
    error = max(pressure.values()) / designed["state"]["max_pressure"] - 1
    runner.require("peak pressure by CalculiX", abs(error) < PEAK, f"error {error:.4f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("snug", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--calculix", action="store_true")
    options = parser.parse_args()
    if options.calculix:
        require_ccx()
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(options.snug.resolve(), options.mpiexec, pathlib.Path(folder))
        if options.calculix:
            check_calculix(runner, options.meshes.parent / "scenes")
        else:
            check_decks(runner, options.meshes)
            check_lacking_parts(runner, options.meshes)
            check_includes(runner, options.meshes)
            check_forces(runner, options.meshes)
            check_wrong_decks(runner, options.meshes)
            check_read_back(runner)
    print("\n".join(runner.wrong) or "all right")
    return bool(runner.wrong)


if __name__ == "__main__":
    sys.exit(main())
