"""Decks with couplings and rigid bodies, in the manner of several pre-processors.

CalculiX distributes forces and moments to nodes with weights by areas, Snug as a traction. Corners of
the loaded face differ by 0.8 % in the plane bracket, of which the middle of the face is compared."""

import itertools

from deck_files import styles
from deck_files.model import Model, Step, pair
from deck_files.parts import Part
from deck_files.single_bodies import Example

REFERENCE, ROTATIONS = 90001, 90002


def reference(position, lines, rotations=False):
    """Return the lines of a reference node, and of its node of rotations."""
    place = ", ".join(map(str, position))
    return (f"*NODE, NSET=REFERENCE\n{REFERENCE}, {place}\n" +
            (f"*NODE, NSET=ROTATIONS\n{ROTATIONS}, {place}\n" if rotations else "") + lines)


def coupling(surface, lines):
    return f"*COUPLING, REF NODE={REFERENCE}, SURFACE={surface}, CONSTRAINT NAME=C1\n{lines}"


def cantilever(kind, cells, before, *steps):
    """Return a model of a beam that is fixed at x = 0. The lines refer to its surface END, its
    nodes END_NODES, and its reference node beside the end."""
    beam = Part(kind, cells, (60., 20., 20.), material="SOFT")
    model = Model(beam, materials={"SOFT": {"ELASTIC": "1000., 0.3"}})
    model.nodes("FIXED", beam, x=0)
    model.nodes("END_NODES", beam, x=60)
    model.surface("END", beam, x=60)
    model.before = before + "*BOUNDARY\nFIXED, 1, 3\n"
    model.steps = [Step(*step) for step in steps]
    for axis in "xyz":
        model.probe(beam, axis, x=30, y=0, z=20)
        model.probe(beam, axis, x=60, y=20, z=0)
    return model


def prepomax_offset_force():
    """A force at a reference node beside the end of a beam of C3D10: bending and torsion."""
    model = cantilever("C3D10", (6, 3, 3),
                       reference((75., 14., 23.), coupling("END", "*DISTRIBUTING\n1, 6\n")),
                       (f"*CLOAD\n{REFERENCE}, 2, 1.\n{REFERENCE}, 3, -3.\n",))
    return Example(styles.prepomax(model), model, .005)


def mecway_moments():
    """Moments about two axes, then about the third axis with a force, on a beam of C3D8."""
    model = cantilever("C3D8", (18, 6, 6),
                       reference((60., 10., 10.), coupling("END", "*DISTRIBUTING\n1, 3\n4, 6\n")),
                       (f"*CLOAD\n{REFERENCE}, 4, 50.\n{REFERENCE}, 5, 80.\n",),
                       (f"*CLOAD, OP=NEW\n{REFERENCE}, 6, -60.\n{REFERENCE}, 1, 10.\n",))
    return Example(styles.mecway(model), model, .005)


def freecad_plane_bracket():
    """A force at a node beside the end of a plane beam of CPS4, distributed over its end."""
    beam = Part("CPS4", (48, 16), (60., 20.), thickness=5.)
    model = Model(beam)
    model.nodes("FIXED", beam, x=0)
    model.surface("END", beam, x=60)
    model.before = (reference((70., 25., 0.), coupling("END", "*DISTRIBUTING\n1, 6\n")) +
                    "*BOUNDARY\nFIXED, 1, 2\n")
    model.steps = [Step(f"*CLOAD\n{REFERENCE}, 1, 2000.\n{REFERENCE}, 2, -400.\n"
                        f"{REFERENCE}, 6, -3000.\n")]
    for axis in "xy":
        model.probe(beam, axis, x=30, y=0)
        model.probe(beam, axis, x=60, y=10)
    return Example(styles.freecad(model), model, .005)


def prepomax_kinematic_force():
    """A rigid end of a beam of C3D20R, with a force at a reference node beside it."""
    model = cantilever("C3D20R", (6, 3, 3),
                       reference((75., 14., 23.), coupling("END", "*KINEMATIC\n1, 3\n")),
                       (f"*CLOAD\n{REFERENCE}, 2, 1.\n{REFERENCE}, 3, -3.\n{REFERENCE}, 4, 20.\n",))
    return Example(styles.prepomax(model), model, .005)


def mecway_rigid_end():
    """A rigid end of a beam of C3D20R that is bent by a moment and a force, and then turned about
    two axes as well."""
    model = cantilever("C3D20R", (6, 3, 3), reference(
        (60., 10., 10.),
        f"*RIGID BODY, NSET=END_NODES, REF NODE={REFERENCE}, ROT NODE={ROTATIONS}\n"
        f"*BOUNDARY\n{REFERENCE}, 1\n{ROTATIONS}, 1\n", True),
        (f"*CLOAD\n{REFERENCE}, 3, -2.\n{ROTATIONS}, 2, 40.\n*BOUNDARY\n{ROTATIONS}, 3\n",),
        (f"*BOUNDARY\n{ROTATIONS}, 1, 1, 0.004\n{ROTATIONS}, 3, 3, -0.002\n",))
    return Example(styles.mecway(model), model, .005)


def freecad_plane_rigid_end():
    """A rigid end of a plane beam of CPS8 with a force and a moment."""
    beam = Part("CPS8", (24, 8), (60., 20.), thickness=5.)
    model = Model(beam)
    model.nodes("FIXED", beam, x=0)
    model.nodes("END_NODES", beam, x=60)
    model.before = reference(
        (70., 25., 0.),
        f"*RIGID BODY, NSET=END_NODES, REF NODE={REFERENCE}, ROT NODE={ROTATIONS}\n"
        f"*BOUNDARY\nFIXED, 1, 2\n{REFERENCE}, 3\n{ROTATIONS}, 1, 2\n", True)
    model.steps = [Step(f"*CLOAD\n{REFERENCE}, 1, 2000.\n{REFERENCE}, 2, -400.\n"
                        f"{ROTATIONS}, 3, -3000.\n")]
    for axis in "xy":
        model.probe(beam, axis, x=30, y=0)
        model.probe(beam, axis, x=60, y=10)
    return Example(styles.freecad(model), model, .005)


def cgx_rigid_punch():
    """A rigid punch, all cells of a body, on a soft base: pressed by a force, and then tilted by a
    moment while the contact stays closed. CalculiX turns the punch by finite angles."""
    base = Part("C3D20R", (4, 4, 4), (20., 20., 20.), material="SOFT")
    punch = Part("C3D8", (4, 4, 1), (20., 20., 5.), material="SOFT", first=5001,
                 shift=(0., 0., 20.))
    model = Model(base, punch, materials={"SOFT": {"ELASTIC": "1000., 0.3"}})
    model.nodes("BOTTOM", base, z=0)
    model.surface("UP", base, z=20)
    model.surface("DOWN", punch, z=0)
    model.before = pair("SI1", "DOWN", "UP", stiffness=2e5) + reference(
        (10., 10., 20.), f"*RIGID BODY, ELSET=E2, REF NODE={REFERENCE}, ROT NODE={ROTATIONS}\n"
        f"*BOUNDARY\nBOTTOM, 1, 3\n{REFERENCE}, 1, 2\n{ROTATIONS}, 1\n{ROTATIONS}, 3\n", True)
    model.steps = [Step(f"*CLOAD\n{REFERENCE}, 3, -2000.\n"),
                   Step(f"*CLOAD\n{ROTATIONS}, 2, 3000.\n")]
    for axis, x in itertools.product("xz", (0, 20)):
        model.probe(base, axis, x=x, y=10, z=15)
    model.probe(punch, "z", x=0, y=10, z=5)
    model.probe(punch, "z", x=20, y=10, z=5)
    return Example(styles.cgx(model), model, .005)
