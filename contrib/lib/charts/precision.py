"""What digits cost: errors of states whose answers are known against unknowns and CPU
seconds."""

import dataclasses
import math

import known_answers
from common import cells, tolerance
from runs import RunError, solve


def p_norm(peak, exponents):
    """Return the response 'peak pressure' of exponent 8 of a pressure p0 (1 - r^2)^(1/2): its
    mean eighth power weighs as the force; exponents: half of the dimensions."""
    def moment(power):  # of (1 - r^2)^power over the contact
        return math.gamma(power + 1) / math.gamma(power + 1 + exponents)
    return peak * (moment(4.5) / moment(.5))**(1 / 8)


def hertz(measure, dimension):
    """Return what known_answers says of a contact, with the response for the largest pressure."""
    def quantities(found):
        (_, _, p0), (_, a, exact) = measure(found, None)
        return {"peak pressure": (found.state["responses"]["peak"],
                                  p_norm(p0, dimension / 2)), "half width": (a, exact)}
    return quantities


def pin(found):
    _, (_, end, exact) = known_answers.pin_in_hole(found, None)
    return {"peak pressure": (found.state["responses"]["peak"], None),
            "end of contact": (end, exact)}


def rings(found):
    """Return Lamé's answers; the stiffnesses of the rings tell the other quantities."""
    pressure = known_answers.lame_pressure("plane stress")
    return {"peak pressure": (found.state["responses"]["peak"], pressure),
            "energy": (found.state["strain_energy"], pressure * .002 * 2 * math.pi),
            "displacement": (found.state["responses"]["sinks"],
                             2 * pressure * 4 * 3 / (2000 * (9 - 4)))}


def responses(face, component="y"):
    """Return the responses of targets and, on a face that is not held, a displacement."""
    entries = {"Responses": "peak, sinks" if face else "peak, force",
               "Response peak/Quantity": "peak pressure"}
    if face:
        return {**entries, "Response sinks/Quantity": "displacement",
                "Response sinks/Face": face, "Response sinks/Component": component}
    return {**entries, "Response force/Quantity": "contact force"}


def target(percent, *names):
    return {"Accuracy/Estimate": "responses",
            "Accuracy/Target": ", ".join(f"{name}: {percent} %" for name in names)}


@dataclasses.dataclass
class Scene:
    """This class has one picture: a file, what is set, {series: {label: entries}}, and the
    entries of the reference, or None where the closed form is exact."""
    file: str
    entries: dict
    quantities: object
    series: dict
    reference: dict
    axes: tuple = ("unknowns", "seconds")


DEGREES = {f"degree {p}": {"Element degree": p} for p in (1, 2)}
MORTAR = {"Contact/Method": "mortar"}
BOTH = ("peak", "potential energy")
PERCENT = {1: (5, 2, 1, .5, .2, .1), 2: (1, .2, .1, .05, .02)}


def uniform(mesh, *counts, last=0, name="uniform"):
    """Return series of both degrees; the finest meshes are for degree 1 alone."""
    return {f"{name}, {degree}": {str(n): {**mesh(n), **entries} for n in
                                  (counts[:-last] if last and i else counts)}
            for i, (degree, entries) in enumerate(DEGREES.items())}


def adapted(start, names=BOTH, percent=PERCENT, name="adapted", entries=None):
    return {f"{name}, {degree}": {f"{t} %": {**start, **of, **(entries or {}), **target(
        t, *names)} for t in percent[of["Element degree"]]} for degree, of in DEGREES.items()}


def unequal(mesh, *counts):
    """Return meshes of which one body has more cells; mesh: of the counts of both bodies."""
    return {f"unequal {method}, degree 1": {
        str(n): {**mesh(n, n * 4 // 3), "Contact/Method": method} for n in counts}
            for method in ("nodal", "mortar")}


def line_contact(pressure, meshes):
    bodies = ("cylinder", "plane")
    return Scene(
        "tests/scenes/adapted-2d.prm",
        {**responses("cylinder.top"), "Body cylinder/Pressure": f"top: {pressure}"},
        hertz(known_answers.line_contact, 1),
        {**uniform(lambda n: {**cells(n, *bodies, dim=2), "Accuracy/Target": ""}, *meshes,
                   last=1), **meshed_by_hand(pressure), **adapted({}),
         **adapted({}, name="adapted mortar", entries=MORTAR)},
        {"Element degree": 2, **target(.01, *BOTH)})


def meshed_by_hand(pressure):
    """Return meshes like that of prm/hertz-2d.prm, refined about the narrow contact."""
    if pressure > .125:
        return {}

    def mesh(n):
        refined = {f"Body {body}/{entry}": value for body in ("cylinder", "plane")
                   for entry, value in (("Local refinements", 4),
                                        ("Refine where", "0.2 - sqrt(x^2 + (y - 1)^2)"))}
        return {**cells(n, "cylinder", "plane", dim=2), **refined, "Accuracy/Target": "",
                "Decomposition/Method": "METIS"}
    return uniform(mesh, 4, 8, 16, 32, last=1, name="by hand")


def solid():
    bodies = ("upper", "lower")
    even = {f"Body {body}/{entry}": "" for body in bodies
            for entry in ("Box fine length", "Box grading")}
    start = {**even, **cells(3, *bodies)}
    return Scene(
        "prm/point-contact.prm", {**responses(None), **cells(3, *bodies)},
        hertz(known_answers.point_contact, 2),
        {**uniform(lambda n: cells(n, *bodies), 5, 7, 11, 15, 19, last=2, name="by hand"),
         **unequal(lambda n, m: {**cells(n, "upper"), **cells(m, "lower")}, 6, 9, 12),
         **adapted(start, percent={1: (10, 5, 2, 1), 2: (1, .2)})},
        {**cells(14, *bodies), "Element degree": 2})


def section():
    bodies = ("upper", "lower")

    def mesh(n, m=None):
        return {f"Body {body}/Box cells": f"{2 * k}, {k}"
                for body, k in zip(bodies, (n, m or n))}
    start = {**mesh(2), **{f"Body {body}/Warp": "" for body in bodies}}
    return Scene(
        "prm/point-contact-axisymmetric.prm", responses(None),
        hertz(known_answers.axisymmetric_point_contact, 2),
        {**uniform(mesh, 6, 12, 24, 48, 96, last=1, name="by hand"), **adapted(start),
         **unequal(mesh, 6, 12, 24, 48)},
        {**start, "Element degree": 2, **target(.01, *BOTH)})


def flat_punch():
    def mesh(n):
        return {"Body punch/Local refinements": n, "Body block/Local refinements": n + 1}
    percent = {1: (5, 2, 1, .5), 2: (1, .5, .2)}
    return Scene(
        "prm/flat-punch.prm", responses("punch.top"), lambda found: {},
        {**uniform(mesh, 0, 1, 2, 3, 4, 5, 6, last=1, name="by hand"),
         **adapted(mesh(0), ("potential energy",), percent),
         **adapted(mesh(0), ("potential energy",), percent, "adapted mortar", MORTAR)},
        {**mesh(0), "Element degree": 2, **target(.01, "potential energy")})


def shrink_fit():
    def mesh(n, m=None):
        return {f"Body {body}/Cells": f"{k}, {k // 6}"
                for body, k in zip(("inner", "outer"), (n, m or n))}
    return Scene(
        "prm/shrink-fit.prm", responses("outer.outer", "normal"), rings,
        {**uniform(mesh, 12, 24, 48, 96, 192, last=1), **adapted(mesh(12)),
         **unequal(mesh, 12, 24, 48, 96)}, None)


def pin_in_hole():
    def mesh(n, m=None):
        m = m or n
        return {"Body pin/Cells": f"{n}, {n // 4}", "Body plate/Cells": f"{m}, {m // 2}"}
    return Scene(
        "prm/pin-in-hole.prm", {**responses("pin.inner")}, pin,
        {**uniform(mesh, 12, 24, 48, 96, 192, last=1), **adapted(mesh(12)),
         **unequal(mesh, 12, 24, 48, 96)},
        {**mesh(24), "Element degree": 2, **target(.02, *BOTH)})


def tolerances():
    """Return the scene of the error of loose forces alone, on one mesh."""
    return Scene(
        "prm/hertz-2d.prm", responses("cylinder.top"), hertz(known_answers.line_contact, 1),
        {name: {f"1e-{k}": {**tolerance(f"1e-{k}"), **of} for k in (2, 3, 4, 6, 8, 10)}
         for name, of in (("active set", {}), ("SMALSE-M", {"Solver/Method": "SMALSE-M"}))},
        tolerance("1e-12"), ("tolerance", "F-mults"))


SCENES = {"line": lambda: line_contact(.125, (16, 32, 64, 128)),
          "wide": lambda: line_contact(2.16, (8, 16, 32, 64, 128)),
          "solid": solid, "section": section, "punch": flat_punch, "fit": shrink_fit,
          "pin": pin_in_hole, "tolerance": tolerances}


# Responses of the program, and what pictures call them.
NAMES = {"sinks": "displacement", "force": "force"}


def solved(scene, entries):
    """Return the Result of a run, and {quantity: (value, closed form or None)}."""
    found = solve(scene.file, {**scene.entries, "Accuracy/Estimate": "none", **entries})
    values = {quantity: (found.state["responses"][name], None)
              for name, quantity in NAMES.items() if name in found.state["responses"]}
    return found, {"energy": (found.state["energy"], None), **values,
                   **scene.quantities(found)}


def estimates(found):
    """Return {quantity: relative error as the program estimates it} of the reference."""
    names = {**NAMES, "peak": "peak pressure", "potential energy": "energy"}
    values = {**found.state["responses"], "potential energy": found.state["energy"]}
    return {names[name]: abs(error / values[name])
            for name, error in found.state["accuracy"]["responses"].items()}


def measure(name, quick):
    """Return rows of the file, those of the table of answers, and what was not solved."""
    scene, rows, failures = SCENES[name](), [], []
    answers, unsure = {}, {}
    if scene.reference:
        reference = {"Accuracy/Estimate": "responses", **scene.reference}
        if quick and "adapted, degree 2" in scene.series:
            reference = {**reference, **next(iter(scene.series["adapted, degree 2"].values()))}
        truth, answers = solved(scene, reference)
        unsure = estimates(truth) if "unknowns" in scene.axes else {}
    for series, meshes in scene.series.items():
        for label, entries in list(meshes.items())[:1 if quick else None]:
            try:
                run, found = solved(scene, entries)
            except RunError as reason:
                failures.append(f"{name}, {series}, {label}: {reason}")
                continue
            unknowns = run.summary["mesh"]["dofs"]
            if "unknowns" in scene.axes and rows and (series, unknowns) == (
                    rows[-1]["series"], rows[-1]["unknowns"]):
                continue  # the mesh of the target before meets this one, too
            for quantity, (value, closed) in found.items():
                right = answers[quantity][0] if answers else closed
                rows.append({
                    "scene": name, "series": series, "mesh": label, "quantity": quantity,
                    "unknowns": unknowns, "seconds": run.on_processor("total"),
                    "F-mults": run.state["f_mults"], "value": value,
                    "error": abs(value / right - 1),
                    "estimate": unsure.get(quantity) or ""})
                if "tolerance" in scene.axes:
                    rows[-1]["tolerance"] = float(label)
    table = [{"quantity": quantity, "value": value if answers else closed, "closed form": closed,
              "estimate": unsure.get(quantity)}
             for quantity, (value, closed) in (answers or found).items()]
    return rows, table, failures
