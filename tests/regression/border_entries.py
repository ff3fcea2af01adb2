"""Inputs that mean something else than they say, or are odd: decimal commas, units, names, places."""

from wrong_entries import Case, wrong

COULOMB = {"Contact/Friction": "Coulomb"}


def comma_cases(body, slave, master):
    """Numbers with a decimal comma, a unit or a semicolon, in entries of all forms."""
    own = f"Body {body}/"
    shape = {"Task": "optimize", "Optimization/Objective": "potential energy"}
    half = ["write 0.5 instead of 0,5"]
    rows = [("a number", "Contact/Search distance", "0,5", half),
            ("a modulus", own + "Young's modulus", "210,5", ["write 210.5"]),
            ("thousands", own + "Young's modulus", "1.000,5", ["a number"]),
            ("a number with a unit", own + "Young's modulus", "210 GPa", ["a number"]),
            ("a whole number", own + "Refinements", "1,5", ["a whole number"]),
            ("a gap", "Contact/Gap", "0,5", half),
            ("a gap in parentheses", "Contact/Gap", "(0,5)", ["arguments of a function"]),
            ("a gap in the parentheses of a function", "Contact/Gap", "min(x, (0,5))",
             ["arguments of a function"]),
            ("a formula", "Contact/Gap", "0,5*x", half),
            ("a gap with a unit", "Contact/Gap", "5 mm", ["formula"]),
            ("two gaps", "Contact/Gap", "0.5; 1", ["formula"]),
            ("a pressure", own + "Pressure", "top: 0,5", half),
            ("a traction", own + "Traction", "top: 0 0 -0,5", half),
            ("a force", own + "Force", "top: 0 0 -0,5", half),
            ("a point", own + "Point force", "top: 0 0 1 at 0,5 0 2", half),
            ("a displacement", own + "Displacement", "top: z = -0,5", half),
            ("a temperature", own + "Temperature", "0,5*x", half),
            ("a body force", own + "Body force", "0, 0, 0,5", half),
            ("a body force of 3 numbers", own + "Body force", "0, 0,5", half),
            ("springs", own + "Springs", "top: z = 0,5", half),
            ("a size", own + "Box size", "0,5, 1", half),
            ("sizes", own + "Box size", "0,5 1 1", half),
            ("bounds", "Shape/Bounds", "-0,5", half),
            ("two bounds", "Shape/Bounds", "-0,5, 0,5", half),
            ("a constraint", "Optimization/Constraints", "volume: <= 0,5 initial", half),
            ("a target", "Accuracy/Target", "potential energy: 0,5 %", half),
            ("a plane", "Shape/Symmetry", "x: 0,5", half)]
    limits = [("Coulomb", "Friction coefficient"), ("Tresca", "Friction bound")]
    return [*(wrong(f"decimal comma: {title}", path, value, names, shape)
              for title, path, value, names in rows),
            *(wrong(f"decimal comma: {law}", f"Contact/{entry}", "0,5", half,
                    {"Contact/Friction": law}) for law, entry in limits),
            *(wrong(f"{law} without a limit", "Contact/Friction", law, [entry, slave, master])
              for law, entry in limits),
            wrong("percentage of friction", "Contact/Friction coefficient", "15 %", ["formula"],
                  COULOMB),
            wrong("entry by its former name", own + "Mesh file", "a.msh", ["renamed to 'File'"]),
            wrong("removal at constant volume", "Shape/Only remove", "true",
                  ["'Optimization/Constraints' = 'volume: initial'"], shape)]


def place_cases(body, slave):
    """Places that only a mesh shows to be wrong, for --validate."""
    tip = {"Responses": "tip", "Response tip/Quantity": "displacement",
           "Response tip/Component": "x"}
    return [
        Case("pair out of reach", {f"Body {body}/Shift": "3, 0, 0"},
             [slave, "a distance of", "x 3 to 4", "x 0 to 1"], []),
        Case("faces that look in one direction", {"Contact/Pairs": f"{body}.right: lower.right"},
             ["a distance of", "do not look at each other", "x 1, y 0 to 1"], []),
        Case("pair beyond its search distance",
             {f"Body {body}/Shift": "0, 0, 0.4", "Contact/Search distance": "0.1"},
             ["a distance of 0.4"], []),
        Case("pair in different units", {f"Body {body}/Shift": "5000, 0, 0"},
             ["a distance of 4999", "x 5000 to 5001", "x 0 to 1"], []),
        wrong("point beside the bodies", "Response tip/Point", "0.5, 0.5, 2.04",
              ["tenth of a cell"], tip)]


def odd_cases(body):
    """What --validate accepts, and what it says: (entries, text in its output)."""
    own = f"Body {body}/"
    case = "Load case turn/Displacement"
    tip = {"Responses": "tip", "Response tip/Quantity": "displacement",
           "Response tip/Component": "x", "Response tip/Point": "0.5, 0.5, 2.03"}
    return [
        ("pairs", {}, " % of the slave side faces the other side"),
        ("large friction", {**COULOMB, "Contact/Friction coefficient": "1 + x"},
         "warning: 'Friction coefficient' of 'upper.bottom: lower.top' is up to 2: coefficients"),
        ("pressure in other units", {own + "Pressure": "top: 2e4"},
         f"warning: the load per area of '{body}.top' is up to 2e+04, but 'Young's modulus' is "),
        ("traction in other units", {own + "Traction": "top: 0 0 -2e4*x"}, "check the units of"),
        ("force in other units", {own + "Force": "top: 0 0 -2e4"}, "check the units of"),
        ("face held for another load case",
         {"Load cases": "fit, turn", case: f"{body}.top: z = -0.01"},
         f"face '{body}.top' is held in load case 'fit', because load case 'turn' prescribes its "
         "displacement"),
        ("refinement of no cell", {own + "Refine where": "-1", own + "Local refinements": "1"},
         f"warning: 'Refine where' of body {body}"),
        ("point next to a body", tip,
         "warning: 'Response tip/Point' = '0.5, 0.5, 2.03' lies outside of the bodies and is moved"),
        ("commas of functions", {"Contact/Gap": "max(0,min(x,y)) + if(x>0, 0, pow(x,2))"},
         "is valid")]


def mesh_texts():
    """Decks and meshes: (title, file name, text, entries, names in the message or output)."""
    nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n"
    kinds = "shells, membranes, rigid elements or faces"
    return [(f"mesh of {kind} only", "thin.inp",
             f"{nodes}*ELEMENT, TYPE={kind}\n1, 1, 2, 3, 4\n", {}, ["1 quadrilateral", kinds])
            for kind in ("S4", "M3D4", "R3D4")]
