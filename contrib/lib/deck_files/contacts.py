"""Decks of bodies in contact, in the manner of five pre-processors.

The contact of CalculiX has a penalty of 90 to 1000 times Young's modulus over the size of a face.
Tangential motions are prescribed, so that they do not depend on how a face sticks."""

from deck_files import styles
from deck_files.model import Model, Step, pair
from deck_files.parts import Part
from deck_files.single_bodies import Example

SOFT = {"SOFT": {"ELASTIC": "1000., 0.3"}}


def stack(kind, cells, sizes, gap=0., upper_cells=None):
    """Return two soft blocks, of which the upper one is a gap above the lower one."""
    return (Part(kind, cells, sizes, material="SOFT"),
            Part(kind, upper_cells or cells, sizes, material="SOFT", first=5001,
                 shift=(0., 0., sizes[-1] + gap)))


def symmetric(model, parts):
    """Define sets that hold two sides of parts, and return the lines of *BOUNDARY."""
    return "*BOUNDARY\n" + "".join(f"{model.nodes(f'SIDE-X{i}', part, x=0)}, 1\n"
                                   f"{model.nodes(f'SIDE-Y{i}', part, y=0)}, 2\n"
                                   for i, part in enumerate(parts))


def cae_general_contact():
    """Three instances of a part with gaps, pressed together by a prescribed displacement, in
    general contact. CalculiX has two contact pairs."""
    blocks = [Part("C3D8", (2, 2, 2), (20., 20., 10.), material="SOFT", first=1 + 1000 * i,
                   shift=(0., 0., 10.05 * i)) for i in range(3)]
    model = Model(*blocks, materials=SOFT)
    sides = symmetric(model, blocks)
    model.nodes("BOTTOM", blocks[0], z=0)
    model.nodes("TOP", blocks[2], z=10)
    model.before = ("*SURFACE INTERACTION, NAME=INTPROP-1\n1.,\n"
                    "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n"
                    "*CONTACT PROPERTY ASSIGNMENT\n , , INTPROP-1\n" + sides + "BOTTOM, 3, 3\n")
    model.steps = [Step("*BOUNDARY\nTOP, 3, 3, -0.5\n", "Step-1")]
    for block in blocks:
        model.probe(block, "z", x=20, y=20, z=5)
        model.probe(block, "x", x=20, y=10, z=5)
    files = styles.cae(model)
    contacts = ""
    for i in range(2):
        model.surface(f"UP{i}", blocks[i], z=10)
        model.surface(f"DOWN{i}", blocks[i + 1], z=0)
        contacts += pair(f"I{i}", f"DOWN{i}", f"UP{i}", stiffness=1e5)
    model.before = contacts + sides + "BOTTOM, 3, 3\n"
    return Example(files, model, ccx=styles.mecway(model))


def cae_friction_steps():
    """Two instances, pressed and then pushed by prescribed displacements until the contact slips,
    as load steps with friction."""
    lower, upper = stack("C3D8", (4, 4, 2), (20., 20., 10.))

    def model_of(stiffness):
        model = Model(lower, upper, materials=SOFT)
        model.nodes("BOTTOM", lower, z=0)
        model.nodes("TOP", upper, z=10)
        model.surface("SLAVE", upper, z=0)
        model.surface("MASTER", lower, z=10)
        model.before = pair("INTPROP-1", "SLAVE", "MASTER", .2, stiffness,
                            "" if stiffness else ", SMALL SLIDING")
        model.before += "*BOUNDARY\nBOTTOM, 1, 3\n"
        model.steps = [
            Step("*BOUNDARY\nTOP, 1, 2\nTOP, 3, 3, -0.4\n", "Press", "0.1, 1.\n"),
            Step("*BOUNDARY, OP=NEW\nBOTTOM, 1, 3\nTOP, 1, 1, 1.\nTOP, 2, 2\nTOP, 3, 3, -0.4\n",
                 "Push", "0.1, 1.\n")]
        model.probe(upper, "x", x=20, y=10, z=5)
        model.probe(lower, "x", x=20, y=10, z=5)
        model.probe(lower, "z", x=20, y=0, z=5)
        return model
    model = model_of(1e5)
    return Example(styles.cae(model_of(0.)), model, ccx=styles.mecway(model))


def cae_plane_punch():
    """A punch of CPS8R on a base, with friction: pressed, and then moved sideways while the contact
    sticks for the most part."""
    base = Part("CPS8R", (12, 4), (60., 20.), thickness=5., material="SOFT")
    punch = Part("CPS8R", (6, 4), (20., 20.), thickness=5., material="SOFT", first=3001,
                 shift=(20., 20., 0.))

    def model_of(stiffness):
        model = Model(base, punch, materials=SOFT)
        model.nodes("BOTTOM", base, y=0)
        model.nodes("TOP", punch, y=20)
        model.surface("SLAVE", punch, y=0)
        model.surface("MASTER", base, y=20)
        model.before = pair("INTPROP-1", "SLAVE", "MASTER", .3, stiffness) + \
            "*BOUNDARY\nBOTTOM, 1, 2\n"
        model.steps = [Step("*BOUNDARY\nTOP, 1\nTOP, 2, 2, -0.5\n", "Press"),
                       Step("*BOUNDARY\nTOP, 1, 1, 0.15\n", "Shear")]
        model.probe(punch, "y", x=0, y=10)
        model.probe(punch, "x", x=20, y=10)
        model.probe(base, "y", x=30, y=10)
        return model
    model = model_of(3e4)
    return Example(styles.cae(model_of(0.)), model, ccx=styles.mecway(model))


def prepomax_hot_bar():
    """A bar that expands against a block behind a gap: the gap is closed by a part of the
    strain."""
    bar = Part("C3D20R", (6, 2, 2), (60., 10., 10.), material="COPPER")
    block = Part("C3D20R", (2, 2, 2), (20., 10., 10.), first=4001, shift=(60.02, 0., 0.))
    model = Model(bar, block, materials={
        "COPPER": {"ELASTIC": "120000., 0.34", "EXPANSION, ZERO=20": "1.7E-5"},
        "STEEL": {"ELASTIC": "210000., 0.3", "DENSITY": "7.8E-9", "EXPANSION, ZERO=20": "1.2E-5"}})
    model.surface("BAR_END", bar, x=60)
    model.surface("BLOCK_END", block, x=0)
    sides = symmetric(model, [bar, block])
    model.nodes("BLOCK_SIDE", block, x=20)
    model.nodes("BLOCK_Z", block, z=0)
    model.nodes("BAR_Z", bar, z=0)
    model.nodes("HOT", bar, x=[5 * i for i in range(13)])
    model.nodes("WARM", block, x=[0, 5, 10, 15, 20])
    sides = sides.replace("SIDE-X1, 1\n", "BLOCK_SIDE, 1\n")
    model.before = pair("Interaction-1", "BAR_END", "BLOCK_END", stiffness=4e6)
    model.before += (sides + "BAR_Z, 3, 3\nBLOCK_Z, 3, 3\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
                     "HOT, 20.\nWARM, 20.\n")
    model.steps = [Step("*TEMPERATURE\nHOT, 120.\nWARM, 45.\n")]
    model.probe(bar, "x", x=55, y=0, z=0)
    model.probe(bar, "x", x=30, y=10, z=10)
    model.probe(bar, "y", x=30, y=10, z=10)
    model.probe(block, "x", x=5, y=0, z=0)
    return Example(styles.prepomax(model), model)


def prepomax_adjusted():
    """A block a small gap above another one. ADJUST closes the gap. A pressure on the elements of a
    set presses, in the second step less, while the bottom is lifted: each step states all loads."""
    lower, upper = stack("C3D8", (3, 3, 3), (30., 30., 30.), gap=.02)
    model = Model(lower, upper, materials=SOFT)
    model.surface("SLAVE", upper, z=0)
    model.surface("MASTER", lower, z=30)
    sides = symmetric(model, (lower, upper))
    model.nodes("BOTTOM", lower, z=0)
    model.element_sets["PRESSED"] = (upper, [e for e, *_ in upper.faces(z=30)])
    model.before = pair("Int-1", "SLAVE", "MASTER", stiffness=1e4, options=", ADJUST=0.05")
    model.before += sides + "BOTTOM, 3\n"
    model.steps = [Step("*BOUNDARY, OP=NEW\n" + sides + "BOTTOM, 3, 3, 0\n*CLOAD, OP=NEW\n"
                        "*DLOAD, OP=NEW\n*DLOAD\nPRESSED, P2, 20\n", "Step-1"),
                   Step("*BOUNDARY, OP=NEW\n" + sides + "BOTTOM, 3, 3, 0.1\n*CLOAD, OP=NEW\n"
                        "*DLOAD, OP=NEW\n*DLOAD\nPRESSED, P2, 12\n", "Step-2")]
    model.probe(upper, "z", x=30, y=30, z=20)
    model.probe(upper, "x", x=30, y=20, z=20)
    model.probe(lower, "z", x=30, y=20, z=20)
    return Example(styles.prepomax(model), model)


def prepomax_clearance():
    """A block on another, with a gap of the mesh that *CLEARANCE replaces by a larger one, which a
    part of the prescribed displacement closes."""
    lower, upper = stack("C3D8", (2, 2, 2), (20., 20., 20.), gap=.05)
    model = Model(lower, upper, materials=SOFT)
    model.surface("SLAVE", upper, z=0)
    model.surface("MASTER", lower, z=20)
    sides = symmetric(model, (lower, upper))
    model.nodes("BOTTOM", lower, z=0)
    model.nodes("TOP", upper, z=20)
    model.before = (pair("Int-1", "SLAVE", "MASTER", stiffness=1e5) +
                    "*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE=0.1\n" + sides + "BOTTOM, 3\n")
    model.steps = [Step("*BOUNDARY\nTOP, 3, 3, -0.6\n")]
    model.probe(upper, "z", x=20, y=20, z=10)
    model.probe(lower, "z", x=20, y=20, z=10)
    model.probe(lower, "x", x=20, y=10, z=10)
    return Example(styles.prepomax(model), model)


def freecad_stack():
    """Blocks of C3D10 with different meshes, pressed unevenly by pressures on single elements."""
    lower, upper = stack("C3D10", (4, 4, 2), (20., 20., 10.), upper_cells=(3, 3, 2))
    model = Model(lower, upper, materials=SOFT)
    model.nodes("ConstraintFixed", lower, z=0)
    model.nodes("ConstraintDisplacementX", upper, x=0)
    model.nodes("ConstraintDisplacementY", upper, y=0)
    model.surface("DEPConstraintContact", upper, z=0)
    model.surface("INDConstraintContact", lower, z=10)
    model.before = pair("INTConstraintContact", "DEPConstraintContact", "INDConstraintContact",
                        stiffness=5e4)
    half = [face for face in upper.faces(z=10) if min(upper.nodes[n][0] for n in face[2]) > 6.]
    load = "".join(f"{e},P{k},12.\n" for e, k, *_ in half)
    model.steps = [Step("** ConstraintFixed\n*BOUNDARY\nConstraintFixed,1\nConstraintFixed,2\n"
                        "ConstraintFixed,3\n\n*BOUNDARY\nConstraintDisplacementX,1\n"
                        "ConstraintDisplacementY,2\n\n*DLOAD\n** ConstraintPressure\n*DLOAD\n" +
                        model.dload(upper, "6.", z=10) + load)]
    model.probe(upper, "z", x=20, y=20, z=10)
    model.probe(upper, "z", x=0, y=20, z=10)
    model.probe(upper, "x", x=20, y=20, z=10)
    model.probe(lower, "z", x=20, y=10, z=5)
    return Example(styles.freecad(model), model)


def cgx_mixed():
    """A punch of C3D8 on a base of C3D20, held at its sides, with files of sets and loads: *DLOAD
    of single elements, which change in the second step."""
    base = Part("C3D20", (3, 3, 2), (30., 30., 10.), material="SOFT")
    punch = Part("C3D8", (3, 3, 2), (30., 30., 10.), material="SOFT", first=5001,
                 shift=(0., 0., 10.))
    model = Model(base, punch, materials=SOFT)
    model.surface("UPPER", punch, z=0)
    model.surface("LOWER", base, z=10)
    sides = symmetric(model, (base, punch))
    model.nodes("BOTTOM", base, z=0)
    model.before = pair("SI1", "UPPER", "LOWER", stiffness=2e4) + sides + "BOTTOM,3,3\n"
    model.steps = [Step("*DLOAD\n>press.dlo\n" + model.dload(punch, "10.", z=10)),
                   Step("*DLOAD, OP=NEW\n>more.dlo\n" + model.dload(punch, "15.", z=10) +
                        model.dload(punch, "5.", x=30) + model.dload(base, "5.", x=30))]
    model.probe(punch, "z", x=30, y=30, z=10)
    model.probe(punch, "x", x=30, y=10, z=5)
    model.probe(base, "z", x=30, y=10, z=5)
    return Example(styles.cgx(model), model)


def mecway_sliding():
    """A block of C3D8 that slides on another by a prescribed displacement and an amplitude, with
    friction, in one step."""
    lower, upper = stack("C3D8", (4, 3, 2), (40., 30., 20.), upper_cells=(3, 2, 2))
    model = Model(lower, upper, materials=SOFT)
    model.nodes("BOTTOM", lower, z=0)
    model.nodes("TOP", upper, z=20)
    model.surface("SLAVE", upper, z=0)
    model.surface("MASTER", lower, z=20)
    model.before = ("*AMPLITUDE, NAME=RAMP\n0., 0., 1., 0.5, 2., 1.\n" +
                    pair("SI1", "SLAVE", "MASTER", .1, 5e4) + "*BOUNDARY\nBOTTOM, 1, 3\n")
    model.steps = [Step("*BOUNDARY, AMPLITUDE=RAMP\nTOP, 3, 3, -1.\n*BOUNDARY\nTOP, 1, 2\n",
                        static="0.25, 1.\n"),
                   Step("*BOUNDARY\nTOP, 1, 1, 1.5\nTOP, 3, 3, -0.5\n", static="0.1, 1.\n")]
    model.probe(upper, "x", x=40, y=15, z=10)
    model.probe(upper, "z", x=40, y=15, z=10)
    model.probe(lower, "x", x=20, y=10, z=10)
    return Example(styles.mecway(model), model)
