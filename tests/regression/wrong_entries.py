"""Wrong entries and command lines, and what the message must hold."""

import collections

# entries: {"Section/Entry": value} set at the end of the scene; names: what the
# message must hold.
Case = collections.namedtuple("Case", "title entries names options")


def wrong(title, path, value, names=(), others=()):
    """One wrong entry, after some others; the message names it and its value."""
    entries = {**{key: good for key, good in dict(others).items()
                  if key != path}, path: value}
    return Case(title, entries, [path.split("/")[-1], value, *names], [])


def patch_cases(shape, box, slave, master):
    """Wrong values of the coordinates and limits of patches."""
    angle = {**shape, "Shape/Coordinates": "angle"}
    modes = {**shape, "Shape/Basis": "formula modes", "Shape/Control points": "",
             "Shape/Direction": ""}
    return [
        wrong("chain of two bodies", "Shape/Face", f"{master} + {slave}", ["one body"], shape),
        wrong("chain with a boundary twice", "Shape/Face", f"{master} + {master}", ["once"],
              shape),
        wrong("unknown coordinates", "Shape/Coordinates", "polar", ["arc length"], shape),
        wrong("axis without a direction", "Shape/Axis", "0, 0, 0", ["not all zero"], angle),
        wrong("flat face without an axis point", "Shape/Axis", "0, 0, 1", ["Axis point"], angle),
        wrong("angle of a face that is not round", "Shape/Coordinates", "angle", ["revolution"],
              shape),
        wrong("unknown symmetry plane", "Shape/Smooth across symmetry", "roof", ["boundaries"],
              shape),
        wrong("symmetry plane off the face", "Shape/Smooth across symmetry", "bottom",
              ["meets the face"], shape),
        wrong("slope below zero", "Shape/Maximum slope", "-1", ["positive"], shape),
        wrong("tool radius of a convex face", "Shape/Minimum tool radius", "1", ["left out"],
              {**shape, "Shape/Convex": "true"}),
        wrong("removal along the face", "Shape/Only remove", "true", ["Direction"],
              {**shape, "Shape/Direction": "1, 0, 0",
               "Optimization/Constraints": "volume: <= initial"}),
        wrong("slope of a box", "Shape/Maximum slope", "1", ["left out"], box),
        wrong("curvature of straight lines", "Shape/Convex", "true", ["degree 2"], shape),
        wrong("angle without an axis", "Shape/Coordinates", "projection", ["angle"],
              {**modes, "Shape/Modes": "0, 0, angle"}),
        # The message names the component, not the whole value.
        Case("coordinate of a face for bodies",
             {**modes, "Shape/Face": "", "Shape/Modes": "0, 0, s"},
             ["Modes", "'s'", "formula of x, y, z"], []),
    ]


def input_cases(body, slave, master):
    """Wrong values of entries. @p body and the faces are the scene's."""
    shape = {"Task": "optimize", "Optimization/Objective": "potential energy",
             "Shape/Basis": "Bezier patch", "Shape/Face": master,
             "Shape/Control points": "2, 2", "Shape/Direction": "0, 0, 1",
             "Shape/Bounds": "-0.1, 0.1"}
    box = {**shape, "Shape/Basis": "Bezier box", "Shape/Face": "",
           "Shape/Box corner": "0, 0, 0", "Shape/Box size": "1, 1, 1",
           "Shape/Control points": "2, 2, 2"}
    own = f"Body {body}/"
    tip = {"Responses": "tip", "Response tip/Quantity": "displacement",
           "Response tip/Component": "x"}
    peak = {"Responses": "peak", "Response peak/Quantity": "peak pressure"}
    friction = {"Contact/Friction": "Coulomb"}
    core = {"Materials": "steel", own + "Region formulas": "core: x - 0.5",
            own + "Young's modulus": "1"}
    return [
        wrong("target that is no number", "Accuracy/Target",
              "potential energy: small", ["1 %"]),
        wrong("target of nothing", "Accuracy/Target", "potential energy: 0 %",
              ["above 0"]),
        wrong("target of no response", "Accuracy/Target", "enrgy: 1 %", ["energy"]),
        wrong("target without an estimate", "Accuracy/Target",
              "potential energy: 1 %", ["Estimate"],
              {"Accuracy/Estimate": "none"}),
        wrong("target of sensitivities", "Accuracy/Target",
              "potential energy: 1 %", ["sensitivity"], {"Task": "sensitivity"}),
        wrong("target of all but the objective", "Accuracy/Target",
              "peak pressure: 1 %", ["objective", "potential energy"], shape),
        wrong("target of variables that depend on the mesh", "Accuracy/Target",
              "potential energy: 1 %", ["node-wise"],
              {**shape, "Shape/Basis": "node-wise", "Shape/Filter radius": "0.1",
               "Shape/Control points": ""}),
        wrong("verified without a target", "Accuracy/Verify", "true"),
        wrong("unknown entry", own + "Yuong's modulus", "1"),
        Case("unknown subsection", {"Elastcity/Degree": "1"}, ["Elastcity"], []),
        wrong("misspelled choice", "Solver/Method", "active sett",
              ["active set", "SMALSE-M"]),
        wrong("wrong task", "Task", "optimise", ["optimize"]),
        wrong("wrong type", own + "Young's modulus", "stiff"),
        wrong("wrong type in a list", own + "Box cells", "2, two, 2"),
        wrong("half a number", "Decomposition/Subdomains", "2.5"),
        wrong("unknown body", "Contact/Pairs", f"{slave}: foundaton.top"),
        wrong("unknown boundary of a pair", "Contact/Pairs",
              f"{slave}: {master}_side"),
        wrong("unknown boundary of a support", own + "Supports", "topp: z"),
        wrong("unknown direction of a support", own + "Supports", "top: w"),
        wrong("displacement without a value", own + "Displacement", "top: z"),
        wrong("displacement of a held component", own + "Displacement",
              "left: x = 0.1", ["Supports"]),
        wrong("force without components", own + "Force", "top: 1"),
        *concentrated_cases(own),
        wrong("load case without a body", "Load case a/Pressure", "x.top: 1",
              others={"Load cases": "a"}),
        wrong("body twice", "Bodies", f"{body}, {body}"),
        wrong("negative modulus", own + "Young's modulus", "-1"),
        wrong("modulus not a number", own + "Young's modulus", "nan"),
        wrong("infinite modulus", own + "Young's modulus", "inf"),
        wrong("modulus that overflows", own + "Young's modulus", "1e-300",
              ["at least 1e-60"]),
        wrong("force that overflows", own + "Force", "top: 0 0 1e+200",
              ["at most 1e+60"]),
        wrong("pressure not a number", own + "Pressure", "top: nan"),
        wrong("Poisson's ratio of a fluid", own + "Poisson's ratio", "0.5"),
        wrong("Poisson's ratio too small", own + "Poisson's ratio", "-1"),
        wrong("unknown material", own + "Materials", "stele", ["steel"],
              {"Materials": "steel", own + "Young's modulus": "1"}),
        wrong("region without a material", own + "Materials", "core: steel",
              ["'body' has no material"], core),
        wrong("unknown region", own + "Materials", "body: steel, cor: steel",
              ["did you mean 'core'"], core),
        wrong("region twice", own + "Materials", "core: steel, core: steel",
              ["different regions"], core),
        wrong("modulus beside materials", own + "Young's modulus", "2",
              ["left out"], {"Materials": "steel", own + "Materials": "steel"}),
        wrong("material of no modulus", "Material steel/Young's modulus", "0",
              others={"Materials": "steel"}),
        wrong("pair of the same face", "Contact/Pairs", f"{slave}: {slave}"),
        wrong("model of another dimension", "Model", "axisymmetric", ["solid"]),
        wrong("thickness of a solid", "Thickness", "2", ["solid"]),
        wrong("one unit", "Units", "mm", ["length, force"]),
        wrong("equal units", "Units", "N, N", ["two different names"]),
        wrong("unknown formulation", own + "Formulation", "b-bar", ["B-bar"]),
        wrong("obstacle that is not there", "Contact/Pairs",
              f"{slave}: floor", ["body.boundary"]),
        wrong("plane without normal", "Obstacle floor/Normal", "0, 0, 0",
              others={"Obstacles": "floor"}),
        wrong("gap that is no formula", "Contact/Gap", "2 * t",
              ["formula of x,y,z"]),
        wrong("limit of no law of friction", "Contact/Friction coefficient", "0.3",
              ["Friction = Coulomb"]),
        wrong("coefficient that is no formula", "Contact/Friction coefficient", "0.3*t",
              ["formula of x,y,z"], friction),
        wrong("friction that drives", "Contact/Friction coefficient", "-0.1",
              ["0 or above"], friction),
        wrong("negative deviation of a profile", "Output/Profile deviation", "-0.5",
              ["at least 0"]),
        wrong("deviation of a profile that is no number", "Output/Profile deviation", "fine",
              ["a number"]),
        wrong("unknown format of a mesh", "Output/Meshes", "msh, vtk", ["among msh, inp"]),
        wrong("friction in a quadratic program", "Output/Export QP", "true",
              ["friction", "quadratic program"], {**friction, "Contact/Friction coefficient": "0.1"}),
        wrong("friction without its solver", "Solver/Method", "SMALSE-M",
              ["active set", "friction"], {**friction, "Contact/Friction coefficient": "0.1"}),
        wrong("part of no boundary", own + "Boundary formulas", "pad: tip & x > 0",
              ["one of the boundaries", "left, right"]),
        wrong("part without a boundary", own + "Boundary formulas", "pad: x > 0",
              ["boundary & FORMULA"]),
        wrong("part with a name that exists", own + "Boundary formulas", "left: top & x > 0",
              ["no boundary has"]),
        wrong("part outside of the body", own + "Boundary formulas", "pad: top & x > 99",
              ["positive on a face"]),
        wrong("part that cuts faces", own + "Boundary formulas", "pad: top & x > 0.321",
              ["cuts", "face", "0.321"]),
        wrong("shape of a part of a side", "Shape/Interior", "linear blending",
              ["Laplace or elasticity", "Boundary formulas"],
              {**shape, f"Body {master.split('.')[0]}/Boundary formulas":
               f"seat: {master.split('.')[1]} & x < 0.5"}),
        Case("part by no formula", {own + "Boundary formulas": "pad: top & t > 0"},
             ["Boundary formulas", "t > 0", "formula of x,y,z"], []),
        wrong("zero cells", own + "Box cells", "0, 2, 2"),
        wrong("disc in 3D", own + "Mesh", "disc", ["Dimension = 2"]),
        wrong("hole larger than the ring", own + "Inner radius", "2",
              others={own + "Mesh": "ring", own + "Supports": ""}),
        wrong("no mesh file", own + "File", "",
              others={own + "Mesh": "file"}),
        wrong("flat box", own + "Box size", "1, 1, 0"),
        wrong("no tolerance", "Solver/Relative tolerance", "0"),
        wrong("a scaled Jacobian no mesh has", "Least scaled Jacobian", "1.5"),
        wrong("empty bounds", "Shape/Bounds", "0.1, -0.1", others=shape),
        wrong("initial design outside the bounds", "Shape/Initial", "0.2",
              others=shape),
        wrong("unknown objective", "Optimization/Objective", "beauty",
              ["potential energy"], shape),
        wrong("unknown response in a constraint", "Optimization/Constraints",
              "weight: initial", ["volume"], shape),
        wrong("unknown quantity", "Response tip/Quantity", "displacment",
              ["displacement"], tip),
        wrong("response without its place", "Optimization/Objective",
              "displacement", ["needs a subsection Response"], shape),
        wrong("point outside the bodies", "Response tip/Point", "0, 0, 99",
              ["outside the bodies"], tip),
        wrong("point in two bodies", "Response tip/Point", "0.5, 0.5, 1",
              ["name one"], tip),
        wrong("unknown body of a response", "Response weight/Body", "hammer",
              others={"Responses": "weight",
                      "Response weight/Quantity": "mass"}),
        wrong("unknown face of a response", "Response tip/Face", f"{body}.x",
              others=tip),
        wrong("constraint on a missing pair", "Response peak/Pair",
              f"{slave}: {slave}", ["no such pair"],
              {**shape, **peak, "Optimization/Constraints": "peak: <= 1"}),
        wrong("p below 1", "Response peak/Exponent", "0.5", others=peak),
        wrong("entry a response does not read", "Response peak/Body", body,
              ["left out"], peak),
        wrong("limit that is none", "Optimization/Constraints", "volume: < 1",
              ["<= 120"], shape),
        wrong("equality where there can be none", "Optimization/Constraints",
              "volume: initial", ["MMA"],
              {**shape, "Optimization/Algorithm": "MMA"}),
        wrong("unknown face to shape", "Shape/Face", f"{body}.x", others=shape),
        wrong("box without a size", "Shape/Box size", "1, 0, 1", others=box),
        wrong("box beside the bodies", "Shape/Box size", "1, 1, 2",
              ["no node"], {**box, "Shape/Box corner": "90, 0, 0"}),
        wrong("all control points fixed", "Shape/Fixed", "border",
              ["no design variables"], shape),
        wrong("filter without a radius", "Shape/Filter radius", "0",
              others={**shape, "Shape/Basis": "node-wise",
                      "Shape/Control points": ""}),
        *patch_cases(shape, box, slave, master),
        wrong("mirror plane off the middle", "Shape/Symmetry", "x: 0.123",
              ["no image"], shape),
    ]


def concentrated_cases(own):
    """Forces at points and along lines, springs and temperatures."""
    force, line, springs = own + "Point force", own + "Line force", own + "Springs"
    points, heat = own + "Point springs", own + "Temperature"
    expands = {own + "Expansion": "1e-5"}
    return [
        wrong("point without a place", force, "top: 0 0 -1", ["x y z at x y z"]),
        wrong("point of two components", force, "top: 0 0 -1 at 0 0", ["3 components"]),
        wrong("point force of two components", force, "top: 0 1 at 0 0 2", ["3 components"]),
        wrong("point force without a force", force, "top: at 0 0 2", ["missing"]),
        wrong("two places of a force", force, "top: 0 0 1 at 0 0 2 at 1 1 2", ["twice"]),
        wrong("force that is no number", force, "top: 0 0 x at 0 0 2", ["number"]),
        wrong("point force that overflows", force, "top: 0 0 1e70 at 0 0 2", ["1e+60"]),
        wrong("point force on no boundary", force, "lid: 0 0 1 at 0 0 2", ["lid"]),
        wrong("line without its end", line, "top: 0 0 -1 from 0 0 2", ["from x y z to"]),
        wrong("line of no length", line, "top: 0 0 -1 from 0 0 2 to 0 0 2", ["different ends"]),
        wrong("line along no boundary", line, "top: 0 0 -1 along rim", ["rim"]),
        wrong("line by two ways", line, "top: 0 0 -1 from 0 0 2 to 1 0 2 along left",
              ["along boundary"]),
        wrong("springs without a stiffness", springs, "top: z", ["components = formula"]),
        wrong("springs along no axis", springs, "top: w = 1", ["components are"]),
        wrong("springs on no boundary", springs, "lid: z = 1", ["lid"]),
        wrong("springs by no formula", springs, "top: z = 1 +", ["Springs"]),
        wrong("two springs in a direction", springs, "top: z = 1, top: xz = 2", ["one direction"]),
        wrong("springs that push away", springs, "top: z = -1", ["must not be negative"]),
        wrong("point springs without a place", points, "top: 0 0 1", ["x y z at x y z"]),
        wrong("negative point spring", points, "top: 0 0 -1 at 0 0 2", ["must not be negative"]),
        wrong("point spring of zero", points, "top: 0 0 0 at 0 0 2", ["must have a stiffness"]),
        wrong("export of springs", "Output/Export QP", "true", ["springs"],
              {springs: "top: z = 1"}),
        wrong("temperature that is no formula", heat, "hot", others=expands),
        wrong("temperature without expansion", heat, "100", ["Expansion"]),
        wrong("temperature of no body", "Load case a/Temperature", "lid: 1",
              ["no body"], {"Load cases": "a"}),
        wrong("temperature of a body that does not expand", "Load case a/Temperature",
              own[5:-1] + ": 1", ["Expansion"], {"Load cases": "a"}),
    ]


def setup_cases(body, slave):
    """What only shows once there are meshes; --validate finds it, too."""
    own = f"Body {body}/"
    return [
        wrong("control point that is not there", "Shape/Fixed", "7"),
        wrong("designs of another size", "Shape/Initial", "0, 0",
              ["6 numbers"]),
        wrong("point beside its boundary", own + "Point force", "top: 0 0 -1 at 0.5 0.5 9",
              ["must be on the boundary"]),
        wrong("line beyond its boundary", own + "Line force",
              "top: 0 0 -1 from 0.5 0.5 2 to 0.5 9 2", ["must be on the boundary"]),
        wrong("boundaries without a common edge", own + "Line force", "top: 0 0 -1 along bottom",
              ["no common edge"]),
        wrong("point spring beside its boundary", own + "Point springs", "top: 0 0 1 at 7 7 7",
              ["must be on the boundary"]),
        Case("pair with nothing opposite", {own + "Shift": "3, 0, 0"},
             ["opposite", slave], []),
        Case("faces paired through their body",
             {"Contact/Pairs": f"{slave}: {body}.top"},
             [f"{body}.top", "overlap", "Interference"], []),
        Case("cells more skewed than allowed",
             {own + "Warp": "z - 1; 0; 0", "Least scaled Jacobian": "0.8"},
             ["Least scaled Jacobian", "0.8", f"body {body}"], []),
        Case("mirrored body", {own + "Warp": "-2*x; 0; 0"},
             [f"body {body} is tangled", "Warp"], []),
        Case("position not finite", {own + "Warp": "0; 0; sqrt(0.9-x)"},
             [own + "Warp", "sqrt(0.9-x)", "must be finite"], []),
    ]


def partial_cases(body):
    """Formulas that only some ranks find without a value."""
    own = f"Body {body}/"
    return [
        Case("pressure not finite", {own + "Pressure": "top: sqrt(0.5-x)"},
             [own + "Pressure", "sqrt(0.5-x)"], []),
        Case("pressure that overflows", {own + "Pressure": "top: 1e200*x"},
             [own + "Pressure", "1e200*x"], []),
        Case("body force not finite", {own + "Body force": "0, 0, sqrt(0.5-x)"},
             [own + "Body force", "sqrt(0.5-x)"], []),
        Case("temperature not finite",
             {own + "Expansion": "1e-5", own + "Temperature": "sqrt(0.5-x)"},
             [own + "Temperature", "sqrt(0.5-x)"], []),
        Case("refined position not finite",
             {own + "Warp": "0; 0; 0*sqrt(abs(x-0.125)-1e-9)",
              own + "Refinements": "1"},
             ["Warp", "must be finite"], []),
    ]


def option_cases():
    """Wrong command lines; the message has the wrong word."""
    return [
        Case("unknown option", {}, ["--outptu"], ["--outptu", "x"]),
        Case("option without its value", {}, ["--output"], ["--output"]),
        Case("malformed setting", {}, ["Task"], ["--set", "Task"]),
        Case("unknown entry in a setting", {}, ["--set", "Yuong"],
             ["--set", "Yuong=4711"]),
        Case("wrong value in a setting", {}, ["Task", "optimise"],
             ["--set", "Task=optimise"]),
        Case("translation of a parameter file", {}, ["--translate", "deck"], ["--translate"]),
        Case("translation and restart", {}, ["--translate", "--restart"],
             ["--translate", "--restart"]),
        Case("restart of a state", {}, ["--restart", "optimization"],
             ["--restart", "--set", "Task=state"]),
    ]
