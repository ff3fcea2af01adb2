"""Decks with bolts, in the manner of several pre-processors.

CalculiX cuts the mesh at the section of a bolt as Snug does, and both sides stay parallel."""

from deck_files import styles
from deck_files.contacts import SOFT, symmetric
from deck_files.model import Model, Step, pair
from deck_files.parts import Part
from deck_files.single_bodies import Example
from deck_files.ties import tie

BOLT = 90001  # node of the force and of the shortening


def section(surface, normal=""):
    """Return the lines of a section with its node, and of a normal if there is one."""
    return (f"*NODE, NSET=BOLT\n{BOLT}, 0., 0., 0.\n"
            f"*PRE-TENSION SECTION, SURFACE={surface}, NODE={BOLT}\n{normal}")


def prepomax_tightened_bar():
    """A bar between two walls, under uniform stress, that is tightened, pulled at its locked length,
    shortened and pressed. The normal of its section points into the elements of the surface, so
    that forces and displacements of its node have the opposite signs."""
    bar = Part("C3D20R", (2, 2, 6), (10., 10., 60.), material="SOFT")
    model = Model(bar, materials=SOFT)
    model.nodes("FIXED", bar, z=0)
    model.nodes("END", bar, z=60)
    model.surface("CUT", bar, z=20)
    model.surfaces["CUT"] = (bar, [face for face in model.surfaces["CUT"][1] if face[1] == 1])
    model.before = (section("CUT", "0., 0., 1.\n") + symmetric(model, [bar]) +
                    "FIXED, 3, 3\nEND, 3, 3\n")
    model.steps = [Step(f"*CLOAD\n{BOLT}, 1, -500.\n"),
                   Step(f"*BOUNDARY, FIXED\n{BOLT}, 1, 1\n*BOUNDARY\nEND, 3, 3, 0.2\n"),
                   Step(f"*BOUNDARY\n{BOLT}, 1, 1, -0.5\n"),
                   Step(f"*BOUNDARY, FIXED\n{BOLT}, 1, 1\n*BOUNDARY\nEND, 3, 3, -0.1\n")]
    model.probe(bar, "z", x=10, y=10, z=15)
    model.probe(bar, "z", x=0, y=0, z=30)
    model.probe(bar, "x", x=10, y=5, z=40)
    return Example(styles.prepomax(model), model, 1e-4)


def mecway_bolted_plates():
    """Two plates between the head and the nut of a bolt, of which a half is in the model: tightened,
    and pulled apart at its locked length in two steps, while the plates open. The loads are small,
    because CalculiX moves the faces in contact by finite rotations."""
    shank = Part("C3D8", (2, 2, 4), (2., 4., 20.), material="SOFT", shift=(0., 0., -10.))
    head, nut, upper, lower = (
        Part("C3D8", cells, size, material="SOFT", first=first, shift=(x, 0., z))
        for cells, size, first, x, z in (
            ((7, 2, 2), (7., 4., 4.), 3001, 0., 10.), ((7, 2, 2), (7., 4., 4.), 6001, 0., -14.),
            ((8, 2, 4), (16., 4., 10.), 9001, 3., 0.), ((8, 2, 4), (16., 4., 10.), 12001, 3., -10.)))
    model = Model(shank, head, nut, upper, lower, materials=SOFT)
    model.surface("CUT", shank, z=10)
    model.surfaces["CUT"] = (shank, [face for face in model.surfaces["CUT"][1] if face[1] == 2])
    model.before = section("CUT")
    inner, outer = [0, .5, 1, 1.5, 2], [3 + .5 * i for i in range(9)]
    for name, part, z, end in (("HEAD", head, 0, 20), ("NUT", nut, 4, 0)):
        model.surface(f"{name}_END", shank, z=end)
        model.surface(f"{name}_SHANK", part, z=z, x=inner)
        model.surface(f"{name}_FACE", part, z=z, x=outer)
        model.before += tie(f"T_{name}", f"{name}_END", f"{name}_SHANK")
    for slave, master in (("HEAD_FACE", model.surface("UP", upper, z=10)),
                          ("NUT_FACE", model.surface("DOWN", lower, z=0)),
                          (model.surface("BOTTOM", upper, z=0), model.surface("TOP", lower, z=10))):
        model.before += pair("I_" + slave, slave, master, stiffness=1e6)
    model.before += "*BOUNDARY\n"
    for i, part in enumerate(model.parts):
        side, wall = (f"{model.nodes(f'{axis}{i}', part, **where)}" for axis, where in (
            ("Y", {"y": 0}), ("X", {"x": 0 if i < 3 else 16})))
        model.before += f"{side}, 2, 2\n{wall}, 1, 1\n"
    far = [12 + i for i in range(5)]
    model.before += f"{model.nodes('HELD', lower, z=0, x=far)}, 3, 3\n"
    model.steps = [Step(f"*CLOAD\n{BOLT}, 1, 10.\n")] + [
        Step(first + "*DLOAD\n" + model.dload(upper, load, z=10, x=far))
        for first, load in ((f"*BOUNDARY, FIXED\n{BOLT}, 1, 1\n", "-0.2"), ("", "-0.4"))]
    model.probe(head, "z", x=0, y=4, z=4)
    model.probe(upper, "z", x=16, y=4, z=10)
    model.probe(upper, "z", x=0, y=4, z=5)
    model.probe(upper, "x", x=0, y=4, z=5)
    model.probe(shank, "z", x=2, y=4, z=5)
    return Example(styles.mecway(model), model, .005)
