"""Decks of tied bodies, in the manner of several pre-processors.

CalculiX ties each slave node to the point of the master side that is nearest to it, so that unlike
meshes differ from those of Snug by a part that decreases with the size of the elements."""

from deck_files import styles
from deck_files.contacts import SOFT
from deck_files.model import Model, Step, pair
from deck_files.parts import Part
from deck_files.single_bodies import Example


def tie(name, slave, master, options=", ADJUST=NO"):
    """Return the lines of a tie."""
    return f"*TIE, NAME={name}, POSITION TOLERANCE=0.2{options}\n{slave}, {master}\n"


def beam(kinds, cells, gap=0., options=", ADJUST=NO"):
    """Return a model of a beam that is fixed at one end and bent by a pressure: two blocks along x,
    tied in the middle."""
    left = Part(kinds[0], cells[0], (40., 20., 20.), material="SOFT")
    right = Part(kinds[1], cells[1], (40., 20., 20.), material="SOFT", first=20001,
                 shift=(40. + gap, 0., 0.))
    model = Model(left, right, materials=SOFT)
    model.nodes("FIXED", left, x=0)
    model.surface("TIE_SLAVE", right, x=0)
    model.surface("TIE_MASTER", left, x=40)
    model.before = tie("TIE-1", "TIE_SLAVE", "TIE_MASTER", options) + "*BOUNDARY\nFIXED, 1, 3\n"
    model.steps = [Step("*DLOAD\n" + model.dload(right, "0.05", z=20))]
    for axis in "xz":
        model.probe(right, axis, x=40, y=0, z=20)
        model.probe(left, axis, x=20, y=0, z=20)
    model.probe(right, "y", x=40, y=20, z=20)
    return model


def prepomax_tied_beam():
    """Blocks whose nodes match. The option ADJUST, which moves no node here, is left out."""
    model = beam(("C3D20R", "C3D20R"), ((4, 2, 2), (4, 2, 2)), options="")
    return Example(styles.prepomax(model), model, .005)


def cae_tied_beam():
    """Instances of C3D20R and C3D8I with unlike meshes."""
    model = beam(("C3D20R", "C3D8I"), ((4, 3, 3), (8, 4, 4)))
    ccx = styles.mecway(model)
    model.surface("PRESSED", model.parts[1], z=20)
    model.steps = [Step("*DSLOAD\nPRESSED, P, 0.05\n", "Step-1")]
    return Example(styles.cae(model), model, .005, ccx)


def freecad_tied_beam():
    """Unlike meshes of tetrahedra."""
    model = beam(("C3D10", "C3D10"), ((4, 2, 2), (6, 3, 3)))
    return Example(styles.freecad(model), model, .005)


def mecway_tied_gap():
    """Blocks whose nodes match, with a small gap between them, across which the tie transmits
    moments in Snug, but not in CalculiX."""
    model = beam(("C3D20R", "C3D20R"), ((4, 2, 2), (4, 2, 2)), gap=.05)
    return Example(styles.mecway(model), model, .005)


def cgx_tied_base():
    """A punch on a base of two tied blocks, in contact with the block that only the tie holds. The
    contact ends at the tied faces."""
    left = Part("C3D8", (4, 4, 4), (20., 20., 20.), material="SOFT")
    right = Part("C3D8", (5, 4, 4), (20., 20., 20.), material="SOFT", first=5001,
                 shift=(20., 0., 0.))
    punch = Part("C3D8", (4, 4, 2), (16., 20., 10.), material="SOFT", first=9001,
                 shift=(20., 0., 20.))
    model = Model(left, right, punch, materials=SOFT)
    model.nodes("FIXED", left, x=0)
    model.nodes("TOP", punch, z=10)
    model.surface("SIDE_LEFT", left, x=20)
    model.surface("SIDE_RIGHT", right, x=0)
    model.surface("UP", right, z=20)
    model.surface("DOWN", punch, z=0)
    model.before = (tie("T1", "SIDE_RIGHT", "SIDE_LEFT") +
                    pair("SI1", "DOWN", "UP", stiffness=2e4) + "*BOUNDARY\nFIXED, 1, 3\n")
    model.steps = [Step("*BOUNDARY\nTOP, 1, 2\nTOP, 3, 3, -0.2\n")]
    model.probe(right, "z", x=20, y=0, z=20)
    model.probe(right, "x", x=20, y=0, z=20)
    model.probe(right, "z", x=4, y=20, z=0)
    model.probe(left, "z", x=10, y=0, z=20)
    return Example(styles.cgx(model), model, .005)


def mecway_tied_contact():
    """A contact whose law is TIED, which is a penalty in CalculiX."""
    model = beam(("C3D8", "C3D8"), ((8, 4, 4), (8, 4, 4)))
    model.before = ("*SURFACE INTERACTION, NAME=GLUE\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n"
                    "1.E6\n*FRICTION\n0.1, 1.E6\n*CONTACT PAIR, INTERACTION=GLUE, "
                    "TYPE=SURFACE TO SURFACE\nTIE_SLAVE, TIE_MASTER\n*BOUNDARY\nFIXED, 1, 3\n")
    return Example(styles.mecway(model), model, .005)
