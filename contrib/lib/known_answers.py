"""What contrib/gallery measures in its scenes, and the known answers.

A measure takes the Result of a scene and that of the scene it is compared with, if there is
one, and returns quantities as (name, value, known answer)."""

import copy
import math


def moduli(*bodies):
    """Return Hertz' modulus E* of (E, nu) pairs."""
    return 1 / sum((1 - nu**2) / E for E, nu in bodies)


def hertz_line(result, load, radius, modulus):
    """Return peak pressure and half width of cylinders under a load per length."""
    a = math.sqrt(4 * load * radius / (math.pi * modulus))
    p0 = 2 * load / (math.pi * a)
    return [("p0", max(result.pressures()), p0),
            ("a", result.half_width(a, lambda p: abs(p["x"])), a)]


def hertz_point(result, load, radius, modulus, r):
    """Return peak pressure and contact radius of spheres under a load."""
    a = (3 * load * radius / (4 * modulus))**(1 / 3)
    p0 = 3 * load / (2 * math.pi * a**2)
    return [("p0", max(result.pressures()), p0),
            ("a", result.half_width(a, r), a)]


def line(radius, *bodies):
    """Return the measure of half of two cylinders; bodies: (E, nu)."""
    return lambda result, _: hertz_line(result, 2 * abs(result.state["contact_force"][1]),
                                        radius, moduli(*bodies))


EQUAL = (1000, .3), (1000, .3)

line_contact = line(4., *EQUAL)
two_cylinders = line(1 / (1 / 4 + 1 / 8), (1000, .3), (4000, .2))
two_cylinders_plane_stress = line(1 / (1 / 4 + 1 / 8), (1000, 0), (4000, 0))
nafems_roller = line(50., (210000, .3), (70000, .3))


def point_contact(result, _):
    load = 4 * abs(result.state["contact_force"][2])
    return hertz_point(result, load, 4., moduli(*EQUAL), lambda p: math.hypot(p["x"], p["y"]))


def axisymmetric_point_contact(result, _):
    load = abs(result.state["contact_force"][1])
    return hertz_point(result, load, 4., moduli(*EQUAL), lambda p: p["x"])


def solid_against_axisymmetric(result, section):
    """The answer is that of the same cylinders as a section, for the load of full ones."""
    load = 4 * abs(result.state["contact_force"][2])
    known = abs(section.state["contact_force"][1])
    a = section.half_width(.23, lambda p: p["x"])
    return [("load", load, known),
            ("p0", max(result.pressures()), max(section.pressures())),
            ("a", result.half_width(a, lambda p: math.hypot(p["x"], p["y"])),
             a)]


# A rigid sphere as the face of a stiff body, whose cells are warped like the others.
STIFF = ["Body upper/Young's modulus=1e9", "Body upper/Displacement=top: y = -0.006",
         "Body upper/Warp=0.7*x*(x^2 - 1); 0.8*y*(y - 1) + "
         "(1 - y)*(4 - sqrt(16 - x^2*(0.3 + 0.7*x^2)^2))",
         "Contact/Gap=0", "Contact/Pairs=lower.top: upper.bottom", "Contact/Slave=first"]


def rigid_against_stiff(result, stiff):
    return [("load", abs(result.state["contact_force"][1]),
             abs(stiff.state["contact_force"][1])),
            ("p0", max(result.pressures()), max(stiff.pressures()))]


# A cone of which the surface rises by 0.01 of the radius, in place of the sphere.
CONE = ["Obstacle tip/Shape=formula", "Obstacle tip/Point=0, 0", "Obstacle tip/Formula=0.01*x - y"]


def indenter(result, _):
    """The answers are those of Hertz for the force 5 on a sphere of the radius 50."""
    p0, a = hertz_point(result, 5., 50., moduli((3000, .35)), lambda p: p["x"])
    return [("depth", -result.state["responses"]["depth"], a[2]**2 / 50.), p0, a]


def cone_radius():
    """Return the radius of the contact of the cone under the force 5, by Sneddon."""
    return math.sqrt(2 * 5. / (math.pi * moduli((3000, .35)) * .01))


def cone_pressure(r, a):
    """Return the pressure of Sneddon under the cone."""
    return moduli((3000, .35)) * .01 / 2 * math.acosh(a / r)


def cone(result, _):
    """The answers are those of Sneddon; the pressure is that at about half of the radius of the
    contact, because it is infinite in the middle."""
    a = cone_radius()
    node = min(result.points, key=lambda p: abs(p["x"] - a / 2))
    return [("depth", -result.state["responses"]["depth"], math.pi / 2 * a * .01),
            ("p at a/2", node["pressure"], cone_pressure(node["x"], a))]


def bearing_housing(result, _):
    """The answers are the force and the moment at the reference point."""
    force, moment = 0., 0.
    for p in result.points:
        if p["pair"] == 0:
            angle = math.atan2(p["y"], p["x"])
            force += p["force"] * math.sin(angle)
            moment -= p["force"] * math.sin(angle) * (p["z"] - 8)
    return [("force", force, 2500.), ("moment", moment, -5000.)]


def bolted_flange(result, _):
    """The bolt has its preload, and the whole load where the joint is open."""
    tension = {of["name"]: of["state"]["bolts"][0]["tension"]
               for of in result.summary["load_cases"]}
    return [("tightened", tension["tighten"], 20000.), ("open", tension["pull-3"], 30000.)]


# A ring and a housing that are nearly rigid.
RIGID = ["Task=state", "Body ring/Young's modulus=2.1e9", "Body housing/Young's modulus=7e8"]


def rigid_housing(result, _):
    """The shaft rises by the clearance."""
    return [("rises", result.state["responses"]["rises"], .02)]


def reference_points(result, _):
    """A beam of the length 5 and EI = 1000 / 12 under moments, and a plane that presses by 0.005 of the
    height on an area of 3, 0.5 beside its point."""
    moments = (.1, .15, .1)
    quantities = [("gradient", result.summary["gradient"]["values"][0],
                   -3 * sum(moments) * 5 / (1000 / 12))]
    for case, moment in zip(result.summary["load_cases"], moments):
        answers = {"turn": moment * 5 / (1000 / 12), "tip": moment * 25 / (2000 / 12),
                   "press": -15, "couple": -7.5}
        quantities += [(f"{name}, {case['name']}", case["state"]["responses"][name], answer)
                       for name, answer in answers.items()]
    held = next(of for of in result.summary["load_cases"][2]["state"]["reactions"]
                if of["name"] == "end")
    return [*quantities, ("reaction of the end", held["force"][0], 1000 * .02 / 5 - 1)]


def gmsh_pin(result, _):
    load = 4 * abs(result.state["contact_force"][2])
    return hertz_point(result, load, 2., moduli((1000, .3)),
                       lambda p: math.hypot(p["x"], p["y"]))


def lame_spheres():
    """Return the pressures over the interference of a ball in a rigid cavity and in a shell; all
    radii are 1, the shell's outer one is 2."""
    E, nu = 1000, .3
    shell = ((1 - 2 * nu) + (1 + nu) * 2**3 / 2) / (E * (2**3 - 1))
    return E / (1 - 2 * nu), 1 / ((1 - 2 * nu) / E + shell)


def lame_pressure(model):
    """Return the pressure of an interference 0.002 at radius 2 between rings from 1 to 2 and 2
    to 3."""
    a, b, c = 1., 2., 3.
    compliance = 0.
    for E, nu, ratio, sign in ((2000, .2, (c * c + b * b) / (c * c - b * b), 1),
                               (1000, .3, (b * b + a * a) / (b * b - a * a), -1)):
        if model == "plane strain":
            E, nu = E / (1 - nu * nu), nu / (1 - nu)
        compliance += (ratio + sign * nu) / E
    return .002 / (b * compliance)


def extremes(result, answer, pair=None):
    """Return the least and the largest pressure as quantities."""
    name = "pressure" if pair is None else f"pressure, pair {pair + 1}"
    return [(f"{name}, {which.__name__}", which(result.pressures(pair)), answer)
            for which in (min, max)]


def lame(model):
    return lambda result, _: extremes(result, lame_pressure(model))


# Persson's pin of equal material without clearance: the tangent of half of the contact angle
# over 2, where the clearance of his solution is zero, and the largest pressure times radius over
# load: (2b / (pi r) + log((r + b) / (r - b)) / (2 pi b^2 (1 + b^2))) with r^2 = 1 + b^2.
PERFECT_FIT, PEAK_OF_FIT = .9135727915594121, .5996286689174073


def pin_in_hole(result, _):
    load = 2 * abs(result.state["contact_force"][1])
    end = result.half_width(PERFECT_FIT, lambda p: math.tan(
        math.atan2(abs(p["x"]), -p["y"]) / 2), first=.8, last=.98)
    return [("p0", max(result.pressures()), PEAK_OF_FIT * load),
            ("end [degrees]", math.degrees(2 * math.atan(end)),
             math.degrees(2 * math.atan(PERFECT_FIT)))]


def gear_pair(result, _):
    """The answers are those of statics, and of cylinders with the radii of the involutes at the
    pitch point."""
    radii, width, moment, alpha = (40., 60.), 10., 1e5, math.radians(20)
    tooth = moment / (radii[0] * math.cos(alpha))
    force = math.hypot(*result.state["contact_force"])
    radius = math.sin(alpha) / sum(1 / r for r in radii)
    modulus = moduli((206000, .3), (206000, .3))
    a = math.sqrt(4 * tooth / width * radius / (math.pi * modulus))
    return [("tooth force", force, tooth),
            ("p0", max(result.pressures()), 2 * tooth / width / (math.pi * a)),
            ("a", result.half_width(a, lambda p: math.hypot(p["x"] - radii[0], p["y"])),
             a)]


# A quarter of the hip joint's section.
HIP_SECTION = ["Dimension=2", "Model=axisymmetric", "Element degree=2",
               "Body head/Force=inner: 0 -2500", "Body head/Supports=start: x",
               "Body cup/Supports=start: x, outer: xy", "Response sinks/Component=y",
               *(f"Body {body}/{entry}" for body in ("head", "cup")
                 for entry in ("Mesh=ring", "Part=quarter", "Rotate=z: -90",
                               "Cells=96, 32"))]


def hip_joint(result, section):
    """The answer is that of the same joint as a section. Pressures of both are on the cup; left out are nodes on
    the symmetry planes, where the head covers less of their areas."""
    def polar(point, axis):
        return math.acos(max(-1., -point[axis] / 14.1))

    def end(of, axis):
        return math.degrees(of.half_width(.74, lambda p: polar(p, axis), .5, .95))
    inner = copy.copy(result)
    inner.points = [p for p in result.points if min(p["x"], p["y"]) > 1e-6]
    top = max(inner.points, key=lambda p: p["pressure"])
    curve = sorted((polar(p, "y"), p["pressure"]) for p in section.points)
    (a, low), (b, high) = next(pair for pair in zip(curve, curve[1:])
                               if pair[1][0] >= polar(top, "z"))
    known = low + (high - low) * (polar(top, "z") - a) / (b - a)
    return [("largest p", top["pressure"], known),
            ("end [degrees]", end(inner, "z"), end(section, "y")),
            ("sinks", *(of.state["responses"]["sinks"] for of in (result, section)))]


def flat_punch(result, _):
    """Quantities are the force within 0.9 of the half width and the pressure in the middle."""
    load = abs(result.state["contact_force"][1])
    middle = min(result.points, key=lambda p: abs(p["x"]))
    inner = math.fsum(abs(p["force"]) for p in result.points if p["x"] < .9)
    edge = max(p["x"] + p["area"] / 2 for p in result.points if p["x"] < .9)
    return [("p in the middle", middle["pressure"], 2 * load / math.pi),
            ("force within 0.9", inner,
             2 * load / math.pi * math.asin(edge))]


def incompressible(result, fine):
    """Nodal pressures are means weighted with the hat functions of the nodes:
    those of the fine solution are taken about the nodes of the coarse one, on
    equal square faces of the unit square."""
    cells = math.sqrt(len(result.points)) - 1

    def mean(node):
        force = math.fsum(
            p["force"] * math.prod(max(0., 1. - cells * abs(p[d] - node[d]))
                                   for d in "xy") for p in fine.points)
        return force / node["area"]
    pairs = [(p["pressure"], mean(p)) for p in result.points]
    return [("p where they differ most",
             *max(pairs, key=lambda pair: abs(pair[0] - pair[1]))),
            ("peak p", max(result.pressures()), max(p for _, p in pairs))]


def uniform_pressure(result, _):
    return extremes(result, 1.)


def stack(result, _):
    return extremes(result, 2., 0) + extremes(result, 2., 1)


def floating_block(result, _):
    """The pressure on the unit top of the block is 1."""
    return [("contact force", abs(result.state["contact_force"][2]), 1.)]


def five_bodies(result, _):
    """Every contact carries the weights above it."""
    return [(f"force on {pair + 1}",
             math.fsum(p["force"] for p in result.points if p["pair"] == pair),
             math.fsum(range(pair + 1, 6))) for pair in range(5)]


def sinking(x):
    """Return how far a half-plane of modulus 1000 sinks less at x than in the middle of an even
    pressure 1 from -1 to 1 (Johnson, 2.5)."""
    return .91 / (1000 * math.pi) * sum(s * math.log(s * s) for s in (1 + x, 1 - x) if s > 0)


def crowned_punch(result, _):
    """The answers are the even pressure 1 and the profile of a rigid punch that has it."""
    points = sorted(result.points, key=lambda p: p["x"])
    return [(f"p, {which.__name__}", which(result.pressures()), 1.)
            for which in (min, max)] + [
        (f"profile at {p['x']:.5g}", p["y"] - points[0]["y"], sinking(p["x"]))
        for p in (points[len(points) // 2], points[-1])]


def shrunk_hub(result, _):
    """The force is that of the start, and no peak is below the force over the area."""
    force = result.summary["initial_state"]["responses"]["hold"]
    found = result.state["responses"]
    return [("force", found["hold"], force),
            ("peak", found["peak"], force / (2 * math.pi * 20 * 15))]


def bush(result, _):
    """A largest pressure q over half of the bore carries q times the radius 10 of
    the pin: at least 50 for the push of 500."""
    push = result.summary["load_cases"][0]["state"]
    return [("peak", push["responses"]["peak"], 50.),
            ("largest p", push["max_pressure"], 50.)]


def block_pair(result, other_way):
    """Minimum mass at a peak, and minimum peak at that mass, have the same design."""
    designs = [run.summary["optimization"]["design"] for run in (result, other_way)]
    return [("peak", result.state["responses"]["peak"], other_way.state["responses"]["peak"]),
            *((f"height {i}", *heights) for i, heights in enumerate(zip(*designs)))]


def leaf_spring(result, _):
    """Masses are as they were; the stress is that of 40 cells along the upper leaf and 2 across."""
    start = result.summary["initial_state"]["responses"]
    found = result.state["responses"]
    return [(name, found[name], start[name])
            for name in ("upper mass", "lower mass")] + [
        ("von Mises norm", found["stress"], 109.5)]
