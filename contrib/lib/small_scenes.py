"""The small scenes of tests/scenes with known answers, and what their options must do."""

import base64
import math
import re
import struct
import zlib

import adapted_scenes
import known_answers
from measures import Below, Check, at, error, same, values
from runs import print_head, print_row, sample, solve


def guided_modulus(E, nu):
    """Return stress over strain along an axis, without strain across it."""
    return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


# M L^2 / 2EI at the tip and the work M^2 L / EI of a beam of length 5.
STIFFNESS = 1000 * 2 * 1**3 / 12
MOMENT = values({"state.responses.tip": 25 / (2 * STIFFNESS), "state.compliance": 5 / STIFFNESS,
                 "mesh.cells": 20})
# A strain of 0.2 along the only stress changes the energy by the factor 1.2.
LARGE_DISPLACEMENTS = values({"state.assumptions.bodies.0.large_displacements": 1.5 * .2})
# Stress 0.3 over an area of 1 m^2; a soft part of 1 m, a stiff one of 2 m.
MESH_REGIONS = values({"state.contact_force.0": -.3e6, "state.responses.end": -.3 * (
    1000 / guided_modulus(10, .4) + 2000 / guided_modulus(2000, .3))})
# Energies int N^2 / 2M over a height of 10, of the weights and of N = 0.1. The guided rubber has
# the von Mises stress (1 - 2 nu) / (1 - nu) N and the yield stress 2.
SOFT, HARD = guided_modulus(10, .4), guided_modulus(210000, .3)
CORE, COAT = 1.2e-9 * 9810 * 10, 7.85e-9 * 9810 * 10  # stresses by weight
TWO_MATERIALS = values({
    "load_cases.0.state.strain_energy": 5 * (20 * 4 * COAT**2 / 3 / HARD + 10 / SOFT * (
        4 * COAT**2 + 2 * COAT * CORE + CORE**2 / 3)),
    "load_cases.1.state.strain_energy": 5 * .1**2 * (10 / SOFT + 20 / HARD),
    "load_cases.1.state.yield_utilization": .1 * .2 / .6 / 2})
# Stress 10 over an area of 4 and a height of 2, between smooth walls
DECK_BLOCKS = values({"state.contact_force.2": -40,
                      "state.responses.top": -10 * 2 / guided_modulus(1000, .3)})
# Of pressure 5 on the box 2 x 1 x 1.
RESPONSES = values({f"state.responses.{name}": answer for name, answer in {
    "potential": -.025, "work": .05, "strain": .025, "space": 2, "weight": 2 * 7.85e-9,
    "end": .003, "side": .0015, "sunk": -.005, "stress": 5, "force": 10, "area": 2,
    "norm": 5 * 2**.25, "peak": 5, "used": .05, "variance": Below(1e-12)}.items()})


# Held, E alpha dT is the stress and its energy; free, there is none.
CAD_TARGET = values({"state.strain_energy": .001 * math.pi
                     * known_answers.lame_pressure("plane strain")})
# A stress of 10 in a volume of 6, and a rotation of 0.01 about the edge of the block.
HELD_POINTS = values({"state.strain_energy": .3, "state.responses.corner": .03 - .01})
HEATED_BAR = values({"load_cases.0.state.responses.stress": 2e5 * 1e-5 * 60,
                     "load_cases.0.state.strain_energy": 120**2 / 2e5 * 4 / 2,
                     "load_cases.1.state.responses.stress": Below(1e-6),
                     "load_cases.1.state.strain_energy": Below(1e-9)})

# Pressure 5 and shears 0.3 * 5 and 2 on areas of 1; slips are 0.01 - shear / 500.
FRICTION_ENTRIES = values({"load_cases.0.state.responses.stuck": 1, **{
    f"load_cases.1.state.responses.{name}": answer for name, answer in {
        "lost": 1.5 * .007 + 2 * .006, "way": .007, "longest": .006, "shear": 1.5, "largest": 2,
        "stuck": Below(1e-6), "force": -3.5, "moment": .75}.items()}})


def plane_on(springs):
    """Return the measure of the plane w = a + b x + c y that balances springs (k, x, y) and the
    loads."""
    loads = [(10, .9, .7), (4, 2.1, 1.4), (2 * math.hypot(2.6, 1.6), 1.5, 1.1), (3 * 2, 3, 1)]

    def moments(items, i, j):
        return sum(size * (1, x, y)[i] * (1, x, y)[j] for size, x, y in items)

    rows = [[*(moments(springs, i, j) for j in range(3)), -moments(loads, i, 0)]
            for i in range(3)]
    for i in range(3):  # Gauss-Jordan
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for j in range(3):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i])]
    corner = rows[0][3] + 3 * rows[1][3] + 2 * rows[2][3]
    return lambda result, _: [
        ("corner", result.state["responses"]["corner"], corner),
        ("reaction", result.state["reactions"][0]["force"][2], sum(F for F, *_ in loads))]


# Four points, and 50 per area with the moments of Gauss points.
POINT_SPRINGS = plane_on([(100, 0, 0), (150, 3, 0), (200, 0, 2), (300, 3, 2)])
WINKLER = plane_on([(50 * 6 / 4, 1.5 + x * 3 / math.sqrt(12), 1 + y * 2 / math.sqrt(12))
                    for x in (-1, 1) for y in (-1, 1)])


def heated_tube(result, _):
    """Timoshenko, Goodier, Theory of Elasticity: a tube in plane strain, here with the external
    pressure of the springs."""
    E, nu, alpha, k, a, b = 2e5, .3, 1e-5, 1e4, 1, 2
    integral = 50 * 5 / 12  # of T r over r
    outer, bore = (2 * (1 + nu) * alpha * r * integral / (b**2 - a**2) for r in (b, a))
    by_pressure = (1 + nu) * b**2 / (E * (b**2 - a**2))
    pressure = k * outer / (1 + k * by_pressure * ((1 - 2 * nu) * b + a**2 / b))
    return [("bore", result.state["responses"]["bore"],
             bore - pressure * by_pressure * 2 * (1 - nu) * a)]


def named_boundaries(result, _):
    """Pressure 1 shortens the height 0.5."""
    return [*known_answers.extremes(result, 1.),
            ("top", -result.state["responses"]["top"], .5 / 1000)]


def boundary_formulas(result, _):
    """Pressure 1 on both parts of the top shortens the height 0.5, and acts on both of the bottom."""
    seat = result.state["pairs"][1]
    return [*known_answers.extremes(result, 1.), ("seat", seat["force"][2], .5),
            ("pad", -result.state["responses"]["pad"], .5 / 1000)]


def lame_cylinder(result, _):
    """Plane strain: a rod of radius 1 is 0.002 too thick, a tube is on a pin 0.001 too thick."""
    E, nu = 1000, .3
    return [("p on the rod", result.mean_pressure(0),
             .002 * E / ((1 + nu) * (1 - 2 * nu))),
            ("p in the tube", result.mean_pressure(1),
             .001 * E * 3 / ((1 + nu) * (1 - 2 * nu + 4)))]


def lame_sphere(result, _):
    """A ball is 0.002 too large for its rigid cavity, one is 0.001 too large for the elastic shell
    around it."""
    cavity, shell = known_answers.lame_spheres()
    return [("p in the cavity", result.mean_pressure(0), .002 * cavity),
            ("p in the shell", result.mean_pressure(1), .001 * shell)]


def pair_entries(result, _):
    """The upper pair has the 4^2 nodes of the coarser face, the lower the 5^2 of the finer
    one."""
    return [*known_answers.extremes(result, 1., 0), *known_answers.extremes(result, 1., 1),
            *((f"rows of {pair['name']}", pair["rows"], rows)
              for pair, rows in zip(result.state["pairs"], (16, 25)))]


def ground_volume(removed):
    """The volume of the unit square less that of the ground profile."""
    return values({"optimization.objective_final": 1 - removed})


# The control points of the even splines descend linearly, or the profile is a parabola.
SLOPE_VOLUME, TOOL_VOLUME = .1 * 73 / 147, 1 / (3 * 5)


def shaped_bore(result, _):
    """Lame's tube of the radii 1.1 and 2 in plane strain, and the derivative of its energy with
    respect to the inner radius, of which each of six control points has a sixth."""
    def energy(a, b=2, E=1000, nu=.3):
        modulus, ratio = E / (1 - nu**2), nu / (1 - nu)
        return math.pi * .5 * b**2 * ((b**2 + a**2) / (b**2 - a**2) - ratio) / modulus
    slope = (energy(1.1 + 1e-5) - energy(1.1 - 1e-5)) / 2e-5
    return [("strain energy", at(result, "state.strain_energy"), energy(1.1)),
            ("gradient", at(result, GRADIENT), [-slope / 6] * 6)]


def rows_of_disc(floor, lid):
    """Return the measure of a disc with 80 nodes on the rim; what comes down on the floor but
    not from the lid is the weight of the polygon."""
    return values({"state.pairs.0.rows": floor, "state.pairs.1.rows": lid,
                   "state.contact_force.1": 40 * math.sin(math.pi / 40)})


def six_blocks(result, _):
    """Forces are what presses from above: the traction on top, body forces of the fifth and the
    second block, and the traction on the side of the second."""
    top = 1.097 * 2.2965 * 1.2125
    fourth = top - .047401 * 2.0248 * 1.2925 * .50111
    lowest = fourth + (.18449 * 2.1753 - .091815) * 1.836 * .49012
    return [(pair["name"], abs(pair["force"][2]), force)
            for pair, force in zip(result.state["pairs"],
                                   (lowest, fourth, fourth, fourth, top))]


def even_stress(result, _):
    """Any mesh has an even stress without error."""
    error = result.state["accuracy"]
    return [("estimated error", error["relative"], Below(1e-6)),
            *((f"estimated error of {name}", of_response, Below(1e-6))
              for name, of_response in error["responses"].items())]


def by_method(result):
    return {row["method"]: row for row in result.summary["gradient"]["methods"]}


def scaling_law(accuracy):
    """A force bends large and small bodies in 2D alike: growing in length makes good
    what growing in height changes."""
    def measure(result, _):
        methods = by_method(result)
        rows = [(name, *methods[name]["values"]) for name in methods]
        return [(f"{name}, relative", abs(a / b + 1), Below(accuracy.get(name, 1e-8)))
                for name, a, b in rows]
    return measure


def array(picture, name, width):
    """Return the rows of a field of a .vtu file: Float32, blocks packed by zlib."""
    text = re.search(rf'{name}[^>]*>\s*([^\s<]+)', picture).group(1)
    head = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    # lengths: of the list, a block, the last block, and each packed one
    size = 4 * (3 + head)
    end = 4 * math.ceil(size / 3)
    packed = struct.unpack(f"<{3 + head}I", base64.b64decode(text[:end]))[3:]
    data, body = b"", base64.b64decode(text[end:])
    for length in packed:
        data, body = data + zlib.decompress(body[:length]), body[length:]
    return list(struct.iter_unpack(f"<{width}f", data))


def shape_gradient(result, _):
    """Its products with the fields of the design variables, (x, 0) and (0, y - 0.5), are the
    gradient; each node counts once, though cells share it."""
    of_nodes = dict(zip(array(result.picture, "<Points>\\s*<DataArray", 3),
                        array(result.picture, 'Name="shape_gradient"', 3)))
    values = result.summary["gradient"]["values"]
    return [("by length", sum(x[0] * g[0] for x, g in of_nodes.items()), values[0]),
            ("by height", sum((x[1] - .5) * g[1] for x, g in of_nodes.items()),
             values[1])]


def one_method(result, beside):
    """There is only the method that is asked for, which finds what the other does."""
    found, other = (of.summary["gradient"] for of in (result, beside))
    return [("methods", len(found["methods"]), 1),
            (f"{found['method']} against {other['method']}", found["values"],
             other["values"])]


def paired_anew(result, _):
    """The answer is the state of the final design, which pairs at that design."""
    found = result.summary["optimization"]
    state = solve("tests/scenes/paired-anew.prm", [
        "Task=state", "Shape/Initial=" + ", ".join(map(repr, found["design"]))])
    return [("peak", found["objective_after_contact_update"], state.state["responses"]["peak"])]


def mirror_images(result, beside):
    """Of two variables the first moves the points on both sides of the middle."""
    outer, middle = at(result, "optimization.design")
    return [("design", [outer, middle, outer], at(beside, "optimization.design"))]


def two_bars(result, _):
    """The sum of F^2 L / EA is least for areas as the forces: (1 + 2)^2 2 / (1000 2)."""
    found = result.summary["optimization"]
    return [("compliance", found["objective_final"], 9e-3),
            ("height of the weak bar", 1 + found["design"][0], 2 / 3),
            ("height of the strong bar", 1 + found["design"][1], 4 / 3)]


def stops_by(reason):
    """Return the measure that a search stops earlier than that beside, and for that reason."""
    def measure(result, beside):
        found = result.summary["optimization"]
        return [(f"stops by {reason}", float(found["stop_reason"] == reason), 1.),
                ("evaluations", found["evaluations"],
                 Below(beside.summary["optimization"]["evaluations"]))]
    return measure


BAR_STOPS = {"gradient tolerance": "Optimization/Gradient tolerance=0.1",
             "objective tolerance": "Optimization/Objective tolerance=1e-2",
             "design tolerance": "Optimization/Design tolerance=0.1",
             "maximum evaluations": "Optimization/Maximum evaluations=4"}
STATE = ("state.energy", "state.max_pressure", "state.contact_force")
F_MULTS = ("state.f_mults",)
GRADIENT = "gradient.values"
# adjoint, direct, semi-analytic, finite differences; the error of the last two
SEMI, OVERALL = ((f"gradient.methods.{i}.values",) for i in (2, 3))
SEMI_ERROR, OVERALL_ERROR = ((f"gradient.methods.{i}.displacement_difference",)
                             for i in (2, 3))
ENERGY = ["Gradient/Compare=false", "Optimization/Objective=potential energy"]

CHECKS = [
    Check("moment", [], MOMENT),
    Check("large-displacements", [], LARGE_DISPLACEMENTS, 1e-9),
    Check("two-materials", [], TWO_MATERIALS),
    Check("mesh-regions", [], MESH_REGIONS),
    Check("named-boundaries", [], named_boundaries),
    Check("deck-blocks", [], DECK_BLOCKS),
    Check("cad-block", ["Solver/Relative tolerance=1e-11"], named_boundaries),
    Check("cad-target", [], CAD_TARGET, 1e-4),
    Check("boundary-formulas", [], boundary_formulas, 1e-6),
    Check("point-loads", [], POINT_SPRINGS, 1e-6),
    Check("point-loads", ["Body block/Box cells=3, 5, 1"], POINT_SPRINGS, 1e-6),
    Check("point-loads", ["Body block/Springs=bottom: xyz = 50", "Body block/Point springs="],
          WINKLER, 1e-6),
    Check("held-points", [], HELD_POINTS, 1e-6),
    Check("held-points", ["Element degree=2", "Decomposition/Subdomains=7"], HELD_POINTS, 1e-6),
    Check("reference-points", [], known_answers.reference_points, 1e-9),
    Check("heated-bar", [], HEATED_BAR, 1e-9),
    Check("heated-tube", [], heated_tube, 1e-5),
    Check("lame-cylinder", [], lame_cylinder, 3e-3),
    Check("lame-cylinder", ["Obstacle pin/Shape=cylinder", "Obstacle pin/Formula="],
          same("state.max_pressure", "state.pairs.1.force.0"), 1e-6, []),
    Check("lame-sphere", [], lame_sphere, 2e-2),
    Check("pair-entries", [], pair_entries, 1e-6),
    Check("search", [], rows_of_disc(17, 11), 1e-6),
    Check("search", ["Pair disc.outer: lid/Search distance=0"], rows_of_disc(17, 27), 1e-6),
    *adapted_scenes.CHECKS,
    Check("six-blocks", [], six_blocks, 1e-8),
    Check("six-blocks", ["Solver/Preconditioner=lumped"], six_blocks, 1e-8),
    Check("paired-anew", [], paired_anew, 1e-7),
    Check("responses", [], RESPONSES, 1e-6),
    Check("friction-entries", [], FRICTION_ENTRIES, 1e-6),
    Check("responses", ["Accuracy/Estimate=responses"], even_stress, 0.),
    Check("responses", ["Accuracy/Estimate=none"],
          same("state.energy", less=("times.accuracy",)), 1e-12, []),
    Check("solver-entries", ["Solver/Factorization=MUMPS"], same(*STATE), 1e-6, []),
    # Rounding, which depends on the kernels of the BLAS for the processor, changes the iterations.
    Check("solver-entries", ["Solver/Factorization=MUMPS"], same(*F_MULTS), 0.1, []),
    Check("solver-entries", ["Solver/Preconditioner=lumped"], same(*STATE, more=F_MULTS), 1e-5, []),
    Check("solver-entries", ["Solver/Preconditioner=none"],
          same(*STATE, more=F_MULTS), 1e-5, ["Solver/Preconditioner=lumped"]),
    Check("solver-entries", ["Solver/Scaling=multiplicity"], same(*STATE, more=F_MULTS), 1e-5, []),
    Check("solver-entries", ["Solver/Method=SMALSE-M"], same(*STATE, more=F_MULTS), 1e-5, []),
    Check("hanging-3d", ["Solver/Soft modes=none"],
          same(*STATE, more=F_MULTS), 1e-5, ["Solver/Soft modes=all"]),
    Check("gradient-entries", [], scaling_law({"semi-analytic": 1e-5})),
    Check("gradient-entries", [], shape_gradient, 1e-5),
    Check("gradient-entries", ["Gradient/Derivatives=forward differences"],
          same(*SEMI, more=SEMI_ERROR), 1e-2, []),
    Check("gradient-entries", ["Gradient/Derivatives=refined forward differences"],
          same(*SEMI, less=SEMI_ERROR), 1e-2, ["Gradient/Derivatives=forward differences"]),
    Check("gradient-entries", ["Gradient/Derivatives=refined central differences"],
          same(*SEMI, less=SEMI_ERROR), 1e-5, []),
    Check("gradient-entries", ["Gradient/Semi-analytic step=1e-3"],
          same(*SEMI, more=SEMI_ERROR), 1e-3, []),
    Check("gradient-entries", ["Gradient/Differences=central"],
          same(*OVERALL, more=OVERALL_ERROR), 1e-5, []),
    Check("gradient-entries", ["Gradient/Differences=forward"],
          same(*OVERALL, more=OVERALL_ERROR), 1e-2, ["Gradient/Differences=central"]),
    Check("gradient-entries", ["Gradient/Differences=backward"],
          same(*OVERALL, more=OVERALL_ERROR), 1e-2, ["Gradient/Differences=central"]),
    Check("gradient-entries", ["Gradient/Step=1e-2"],
          same(*OVERALL, more=OVERALL_ERROR), 1e-5, []),
    Check("gradient-entries", [*ENERGY, "Gradient/Method=energy"], one_method, 1e-8,
          ENERGY),
    Check("gradient-entries", [*ENERGY, "Gradient/Method=finite differences"],
          one_method, 1e-8, ENERGY),
    Check("spline-box", ["Gradient/Method=direct"], one_method, 1e-8, []),
    Check("spline-box", [], same(GRADIENT), 1e-8,
          ["Shape/Basis=Bezier box", "Shape/Degree=3"]),
    Check("spline-box", ["Gradient/Method=direct", "Gradient/Solves=recycled"],
          same(GRADIENT), 1e-6, ["Gradient/Method=direct"]),
    Check("elastic-interior", [], same("optimization.objective_final"), 1e-4,
          ["Shape/Interior=linear blending"]),
    Check("elastic-interior", [],
          same("optimization.objective_final",
               less=("work.assembled_subdomains", "work.numeric_factorizations")),
          1e-4, ["Shape/Reach=0"]),
    Check("ground-profile", [], ground_volume(SLOPE_VOLUME), 1e-6),
    Check("ground-profile", ["Optimization/Algorithm=MMA"], ground_volume(SLOPE_VOLUME), 1e-4),
    Check("ground-profile", ["Task=sensitivity"],
          values({"profile.0.deviation": Below(1e-9), "profile.0.asked": 1e-9}), 1e-6),
    Check("ground-profile", ["Shape/Maximum slope=0", "Shape/Minimum tool radius=5"],
          ground_volume(TOOL_VOLUME), 1e-6),
    Check("ground-profile", ["Shape/Maximum slope=0", "Shape/Convex=true"], ground_volume(0),
          1e-6),
    Check("ground-profile", ["Shape/Coordinates=projection"], ground_volume(SLOPE_VOLUME), 1e-6),
    Check("shaped-bore", [], shaped_bore, 1e-3),
    Check("tied-points", [], mirror_images, 1e-4, ["Shape/Symmetry="]),
    Check("tied-points", [], same("optimization.design"), 1e-8, ["Shape/Fixed=0, 4"]),
    Check("tied-points", [], same(more=("optimization.objective_final",)), 0., ["Shape/Fixed="]),
    Check("tied-points", [], same("optimization.design"), 5e-3, ["Shape/Initial=0"]),
    Check("two-bars", [], two_bars, 1e-6),
    Check("two-bars", ["Optimization/Algorithm=MMA"], two_bars, 1e-4),
    *(Check("two-bars", [entry], stops_by(reason), 0., []) for reason, entry in BAR_STOPS.items()),
]


def text_of(value):
    """Return a number as text, or the largest of several."""
    if isinstance(value, list):
        return f"{max(value, key=abs):.6g} of {len(value)}"
    return ("< " if isinstance(value, Below) else "") + f"{value:.6g}"


def run():
    """Print the table of the checks, and return what is wrong as lines."""
    print_head("scene", "with", "quantity", "found", "answer", "error")
    failures = []
    for check in sample(CHECKS):
        scene, given = f"tests/scenes/{check.scene}.prm", "; ".join(check.entries)
        beside = solve(scene, check.beside) if check.beside is not None else None
        for name, value, answer in check.measure(solve(scene, check.entries), beside):
            off = error(value, answer)
            print_row(check.scene, given, name, text_of(value), text_of(answer), f"{off:.1e}")
            if not off <= check.allowed:
                failures.append(f"{check.scene}, {given}: {name} is {value} instead of "
                                f"{text_of(answer)}")
    return failures
