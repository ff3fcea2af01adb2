"""Decks of bodies without contact, in the manner of five pre-processors.

Each function returns an Example: the files that Snug reads, those that CalculiX reads if they
differ, the model with the points of comparison, and the bound of the differences."""

import collections
import math

from deck_files import styles
from deck_files.model import STEEL, Model, Step
from deck_files.parts import Part

# bound: of the difference over the largest displacement; ccx: files of CalculiX, or None
Example = collections.namedtuple("Example", "files model bound ccx", defaults=[.01, None])


def cae_cantilever():
    """A beam of C3D8I, moved by its instance: a traction along an oblique direction, of which the
    half of an amplitude acts, and gravity. CalculiX has nodal forces instead of TRVEC."""
    beam = Part("C3D8I", (20, 2, 4), (100., 10., 10.), shift=(5., -3., 20.))
    model = Model(beam, before="*AMPLITUDE, NAME=AMP-1\n0., 0., 1., .5, 2., 1.\n"
                               "*BOUNDARY\nSET-1, ENCASTRE\n")
    model.nodes("SET-1", beam, x=0)
    model.surface("SURF-1", beam, x=100)
    gravity = "*DLOAD\n, GRAV, 9810., 0., 0., -1.\n"
    model.steps = [Step("*DSLOAD, AMPLITUDE=AMP-1\nSURF-1, TRVEC, 20., 0.6, 0., -0.8\n" + gravity,
                        "Step-1", "1., 1., 1E-05, 1.\n")]
    for axis in "xz":
        model.probe(beam, axis, x=100, y=5, z=10)
        model.probe(beam, axis, x=50, y=5, z=0)
    files = styles.cae(model)
    model.before = "*BOUNDARY\nSET-1, 1, 3\n"
    model.steps = [Step("*CLOAD\n" + beam.cloads((6., 0., -8.), x=100) +
                        gravity.replace(", GRAV", "Part0, GRAV"))]
    return Example(files, model, ccx=styles.mecway(model))


def cae_plane_beam():
    """A thin beam of CPS4I, pressed and pulled. CalculiX, which has no CPS4I, has CPS8."""
    def make(kind):
        beam = Part(kind, (24, 4), (60., 6.), thickness=2.5)
        model = Model(beam, before="*BOUNDARY\nLEFT, 1, 2\n")
        model.nodes("LEFT", beam, x=0)
        model.surface("TOP", beam, y=6)
        model.surface("END", beam, x=60)
        model.steps = [Step("*DSLOAD\nTOP, P, 2.\nEND, P, -30.\n", "Step-1")]
        model.probe(beam, "y", x=60, y=3)
        model.probe(beam, "y", x=30, y=0)
        model.probe(beam, "x", x=60, y=6)
        return beam, model
    files = styles.cae(make("CPS4I")[1])
    beam, model = make("CPS8")
    # *DSLOAD on plane elements, as single elements
    model.steps = [Step("*DLOAD\n" + model.dload(beam, "2.", y=6) +
                        model.dload(beam, "-30.", x=60))]
    return Example(files, model, ccx=styles.mecway(model))


def prepomax_plate():
    """A plate of C3D20R under pressure, held at the edges of its bottom and at single nodes. C3D20R
    deforms more at the edges than the full integration of Snug: C3D20 differs by 0.13 %."""
    plate = Part("C3D20R", (6, 6, 2), (60., 60., 6.))
    model = Model(plate, before="*BOUNDARY\nEDGE-1, 3, 3\nEDGE-2, 3, 3\n"
                                "CORNER, 1, 3, 0.\nGUIDE, 2, 2, 0.\n")
    model.nodes("EDGE-1", plate, x=0, z=0)
    model.nodes("EDGE-2", plate, x=60, z=0)
    model.nodes("CORNER", plate, x=0, y=0, z=0)
    model.nodes("GUIDE", plate, x=60, y=0, z=0)
    model.element_sets["INTERNAL_TOP"] = (plate, [e for e, *_ in plate.faces(z=6)])
    model.steps = [Step("*DLOAD\nINTERNAL_TOP, P2, 1.5\nSolid_part-1, GRAV, 9.81E5, 0, 0, -1\n")]
    for where in ({"x": 30, "y": 30}, {"x": 30, "y": 0}):
        model.probe(plate, "z", z=6, **where)
    model.probe(plate, "x", x=60, y=60, z=6)
    return Example(styles.prepomax(model), model, bound=.015)


def prepomax_reduced():
    """A beam of C3D8R, with forces in three steps of which the second keeps the force of the first
    and the third ends all. C3D8R of CalculiX is too flexible in bending by 1 / layers^2 = 1.6 %.
    The forces are those of linear faces, which displace corners of Snug's quadratic faces more, so
    that no displacement is compared at the end of the beam."""
    beam = Part("C3D8R", (16, 1, 8), (50., 5., 10.))
    model = Model(beam, before="*BOUNDARY\nFIXED, PINNED\n")
    model.ccx_lines = {"PINNED": "1, 3", "pinned": "1, 3"}
    model.nodes("FIXED", beam, x=0)
    model.steps = [
        Step("*CLOAD\n" + beam.cloads((0., 0., -4.), x=50), "First"),
        Step("*CLOAD\n" + beam.cloads((90., 0., 0.), x=50), "Second"),
        Step("*BOUNDARY, OP=NEW\n*BOUNDARY\nFIXED, 1, 3\n*CLOAD, OP=NEW\n*DLOAD, OP=NEW\n*DLOAD\n" +
             model.dload(beam, 3., z=10), "Third")]
    model.probe(beam, "z", x=43.75, y=5, z=10)
    model.probe(beam, "x", x=43.75, y=0, z=0)
    model.probe(beam, "z", x=25, y=0, z=0)
    return Example(styles.prepomax(model), model, bound=.025)


def freecad_cantilever():
    """A beam of C3D10 with many nodal forces, and faces of S6 in a set that CalculiX does not
    get."""
    beam = Part("C3D10", (10, 2, 2), (100., 20., 20.))
    model = Model(beam, before="*BOUNDARY\nConstraintFixed,1\nConstraintFixed,2\n"
                               "ConstraintFixed,3\n")
    model.nodes("ConstraintFixed", beam, x=0)
    model.steps = [Step("** FemConstraintForce\n*CLOAD\n** node loads on shape: Box:Face2\n" +
                        beam.cloads((0., 2., -6.), x=100) + "\n*DLOAD\n** Pressure\n" +
                        model.dload(beam, .8, z=20))]
    for axis in "xyz":
        model.probe(beam, axis, x=100, y=20, z=20)
    model.probe(beam, "z", x=50, y=0, z=0)
    ccx = styles.freecad(model)
    faces = beam.faces(x=100)
    model.extra_elements = "** Faces elements\n*ELEMENT, TYPE=S6, ELSET=Efaces\n" + "".join(
        ", ".join(map(str, [9000 + i, *corners, *beam.middles(corners)])) + "\n"
        for i, (_, _, corners, _) in enumerate(faces))
    return Example(styles.freecad(model), model, ccx=ccx)


def freecad_wedges():
    """A block of C3D15 held at single nodes, under its weight on springs, with a beam that belongs
    to no cell in the deck of Snug."""
    block = Part("C3D15", (3, 3, 4), (30., 20., 40.))
    model = Model(block)
    model.nodes("POINT", block, x=0, y=0, z=0)
    model.nodes("LINE", block, x=30, y=0, z=0)
    feet = block.on(x=[0, 30], y=[0, 20], z=0)
    springs = "".join(f"{8000 + i}, {n}\n" for i, n in enumerate(feet))
    model.extra_elements = "*ELEMENT, TYPE=SPRING1, ELSET=FEET\n" + springs
    model.before = ("*SPRING, ELSET=FEET\n3\n50.\n*BOUNDARY\nPOINT, 1, 2\nLINE, 2\n")
    model.steps = [Step("*DLOAD\nEall, GRAV, 9810000., 0., 0., -1.\n*CLOAD\n" +
                        block.cloads((0., 0., -1.), z=40))]
    model.probe(block, "z", x=0, y=0, z=40)
    model.probe(block, "z", x=30, y=20, z=40)
    model.probe(block, "x", x=30, y=20, z=20)
    ccx = styles.freecad(model)
    for name, text in ccx.items():
        ccx[name] = text.replace("Eall, GRAV", "MaterialSolid0, GRAV")
    model.extra_elements += ("*NODE\n7001, 0, 0, 90\n7002, 10, 0, 90\n"
                             "*ELEMENT, TYPE=B31, ELSET=RULER\n8101, 7001, 7002\n")
    return Example(styles.freecad(model), model, ccx=ccx)


def hole_place(side, radius):
    """Return the formula that places a block (share of the radius, share of the quarter) as a
    quarter of a plate with a hole."""
    def place(r, t, z):
        angle = .5 * math.pi * t
        x, y = math.cos(angle), math.sin(angle)
        outer = side / max(x, y)
        distance = radius + (outer - radius) * r
        return (distance * x, distance * y, z)
    return place


def cgx_plate_with_hole():
    """A quarter of a plate with a hole of C3D20R, pulled. Sets, supports and loads are in files of
    their own."""
    plate = Part("C3D20R", (6, 8, 1), (1., 1., 2.), place=hole_place(20., 5.))
    model = Model(plate)
    model.nodes("SYMY", plate, y=0)
    model.nodes("SYMX", plate, y=1)
    model.nodes("BACK", plate, z=0)
    right = [face for face in plate.faces(x=1)
             if all(plate.nodes[n][0] > 20. - 1e-9 for n in face[2])]
    model.before = "*BOUNDARY\nSYMY,2,2\nSYMX,1,1\nBACK,3,3\n"
    model.steps = [Step("*DLOAD\n>pull.dlo\n" + "".join(
        f"{e},P{k},-100.\n" for e, k, *_ in right))]
    model.probe(plate, "x", x=1, y=.0, z=2)
    model.probe(plate, "y", x=1, y=1, z=2)
    model.probe(plate, "x", x=0, y=0, z=2)
    model.probe(plate, "y", x=0, y=1, z=0)
    return Example(styles.cgx(model), model)


def cgx_ring():
    """A ring of CAX8R on its foot under its weight with an inner pressure, then with an outer
    one."""
    ring = Part("CAX8R", (6, 4), (20., 10.), corner=(30., 0.))
    model = Model(ring)
    model.nodes("FOOT", ring, y=0)
    model.before = "*BOUNDARY\nFOOT, 2\n"
    model.steps = [Step("*DLOAD\n>inside.dlo\n" + model.dload(ring, 50., x=30) +
                        "*DLOAD\nE1, GRAV, 9.81E6, 0., -1.\n"),
                   Step("*BOUNDARY, OP=NEW\nFOOT, 2, 2\n*DLOAD, OP=NEW\n" +
                        model.dload(ring, 20., x=50))]
    model.probe(ring, "x", x=30, y=10)
    model.probe(ring, "x", x=50, y=5)
    model.probe(ring, "y", x=40, y=10)
    return Example(styles.cgx(model), model)


def cgx_dam():
    """A dam of CPE8 under its weight and the pressure of the water, by layers."""
    def place(x, y, z):
        return (x * (1. - .7 * y / 40.), y, z)
    dam = Part("CPE8", (6, 10), (30., 40.), place=place, material="CONCRETE")
    model = Model(dam, materials={"CONCRETE": {"ELASTIC": "30000., 0.2", "DENSITY": "2.4E-3"}})
    model.nodes("ROCK", dam, y=0)
    water = "".join(f"{e},P{k},{.01 * (38. - 4. * i):.4f}\n"
                    for i, (e, k, *_) in enumerate(dam.faces(x=0)))
    model.before = "*BOUNDARY\nROCK,1,2\n"
    model.steps = [Step("*DLOAD\nE1, GRAV, 9.81, 0., -1., 0.\n"),
                   Step("*DLOAD\n>water.dlo\n" + water)]
    model.probe(dam, "x", x=0, y=40)
    model.probe(dam, "y", x=30, y=40)
    model.probe(dam, "x", x=30, y=20)
    return Example(styles.cgx(model), model)


def mecway_quarter_ring():
    """A sector of a ring of C3D20R with an inner pressure. A cylindrical *TRANSFORM holds both ends
    in circumference and the outer face along the radius."""
    def place(r, t, z):
        angle = math.radians(t)
        return (10. + r * math.cos(angle), 5. + r * math.sin(angle), z)
    ring = Part("C3D20R", (3, 6, 2), (20., 60., 15.), corner=(30., 20., 0.), place=place)
    model = Model(ring)
    model.nodes("ENDS", ring, y=[20, 80])
    model.nodes("OUTER", ring, x=50)
    model.nodes("BOTTOM", ring, z=0)
    model.before = "".join(f"*TRANSFORM, NSET={name}, TYPE=C\n10., 5., 0., 10., 5., 1.\n"
                           for name in ("ENDS", "OUTER"))
    model.steps = [Step("*BOUNDARY\nENDS, 2, 2, 0.\nOUTER, 1, 1, 0.\n*BOUNDARY\nBOTTOM, 3, 3\n"
                        "*DLOAD\n" + model.dload(ring, 60., x=30))]
    for axis in "xy":
        model.probe(ring, axis, x=30, y=50, z=15)
        model.probe(ring, axis, x=40, y=20, z=15)
    model.probe(ring, "z", x=30, y=50, z=15)
    return Example(styles.mecway(model), model)


def mecway_twisted_tube():
    """A quarter of a tube of C3D8 about an oblique axis, with supports along the directions of a
    cylindrical *TRANSFORM: its top is turned about the axis and moved along it, its foot is held in
    these directions, and the nodes of a line move along the radius. The elements are those of Snug,
    so that the bound is that of the digits of CalculiX."""
    c, s = math.cos(math.radians(25.)), math.sin(math.radians(25.))

    def place(r, t, z):
        angle = math.radians(t)
        x, y = r * math.cos(angle), r * math.sin(angle)
        return (4. + x * c + z * s, 7. + y, z * c - x * s)
    tube = Part("C3D8", (2, 6, 5), (10., 90., 40.), corner=(10., 0., 0.), place=place)
    model = Model(tube)
    model.nodes("FOOT", tube, z=0)
    model.nodes("TOP", tube, z=40)
    model.nodes("LINE", tube, x=20, z=16)
    axis = f"4., 7., 0., {4. + s:.12f}, 7., {c:.12f}\n"
    model.before = "".join(f"*TRANSFORM, NSET={name}, TYPE=C\n{axis}"
                           for name in ("FOOT", "TOP", "LINE"))
    model.before += "*BOUNDARY\nFOOT, 2, 3\nLINE, 1, 1, 0.01\n"
    model.steps = [Step("*BOUNDARY\nTOP, 2, 2, 0.03\nTOP, 3, 3, 0.01\n")]
    for axis in "xyz":
        model.probe(tube, axis, x=20, y=45, z=40)
        model.probe(tube, axis, x=10, y=90, z=24)
    return Example(styles.mecway(model), model, bound=1e-5)


def mecway_oblique():
    """A block turned by 30 degrees with a symmetry plane, whose normal a rectangular *TRANSFORM
    gives, and forces along the turned axes, in equilibrium but for their moment and the tension. A
    mass has no effect."""
    turn = math.radians(30.)
    c, s = math.cos(turn), math.sin(turn)
    block = Part("C3D20", (8, 2, 2), (40., 8., 10.), material="ALU",
                 place=lambda x, y, z: (x * c - y * s, x * s + y * c, z))
    model = Model(block, materials={"ALU": {"ELASTIC": "70000., 0.33"}, "STEEL": STEEL})
    model.nodes("PLANE", block, x=0)
    model.nodes("CORNER", block, x=0, y=0, z=0)
    model.nodes("FLOOR", block, x=0, z=0)
    model.nodes("UPPER", block, x=40, y=[0, 8], z=10)
    model.nodes("LOWER", block, x=40, y=[0, 8], z=0)
    tip, = block.on(x=40, y=4, z=5)
    model.extra_elements = (f"*ELEMENT, TYPE=MASS, ELSET=LAMP\n7000, {tip}\n"
                            "*MASS, ELSET=LAMP\n0.001\n")
    axes = f"{c:.12f}, {s:.12f}, 0., {-s:.12f}, {c:.12f}, 0.\n"
    model.before = ("".join(f"*TRANSFORM, NSET={name}, TYPE=R\n{axes}"
                            for name in ("PLANE", "UPPER", "LOWER")) +
                    "*BOUNDARY\nPLANE, 1\nFLOOR, 3\nCORNER, 1, 3\n")
    model.steps = [Step("*CLOAD\nUPPER, 1, 500.\nLOWER, 1, -300.\nUPPER, 2, 30.\nLOWER, 2, -30.\n"
                        "UPPER, 3, -60.\nLOWER, 3, 60.\n")]
    for axis in "xyz":
        model.probe(block, axis, x=30, y=4, z=5)
        model.probe(block, axis, x=20, y=8, z=10)
    return Example(styles.mecway(model), model)
