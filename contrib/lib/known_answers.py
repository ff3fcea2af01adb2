"""What contrib/gallery measures in its scenes, and the known answers.

A measure takes the Result of a scene and that of the scene it is compared with, if there is
one, and returns quantities as (name, value, known answer)."""

import copy
import math

from runs import RunError, run


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


def half_width_by_moments(points, force):
    """Return the half width of the semi-ellipse with the second moment of the forces of points
    along x about their own centre."""
    forces = [(p["x"], force(p)) for p in points]
    total = math.fsum(f for _, f in forces)
    centre = math.fsum(x * f for x, f in forces) / total
    return 2 * math.sqrt(math.fsum((x - centre)**2 * f for x, f in forces) / total)


def shear_force(point):
    return point["traction_x"] * point["area"]


def cattaneo(result, _):
    """Half widths c of the stick zone are those of mu p - q, over the half width of p: (c / a)^2 is
    1 - T / mu P, and on the way back from T1 it is 1 - (T1 - T) / 2 mu P. The loop loses
    4 (mu P)^2 / (pi E*) ((1 - t) log(1 - t) + t - t^2 / 2) with t = T1 / mu P."""
    friction, load, modulus, t = .5, 8.6, moduli(*EQUAL), .75

    def stick(name, limit):
        points = result.cases[name]
        return (half_width_by_moments(points, limit) /
                half_width_by_moments(points, lambda p: p["force"]))

    def loaded(point):  # the force on the cylinder is along x, that on the slave against it
        return friction * point["force"] - abs(shear_force(point))
    start = {p["x"]: shear_force(p) for p in result.cases["more"]}
    back = stick("loop-1", lambda p: 2 * friction * p["force"] -
                 abs(shear_force(p) - start[p["x"]]))
    lost = math.fsum(case["state"]["friction"]["dissipation"]
                     for case in result.summary["load_cases"] if "loop" in case["name"])
    return [("c/a at 1/2", stick("half", loaded), math.sqrt(1 / 2)),
            ("c/a at 3/4", stick("more", loaded), math.sqrt(1 - t)),
            ("c/a on the way back at 0", back, math.sqrt(1 - t / 2)),
            ("work lost in the loop", lost, 4 * (friction * load)**2 / (math.pi * modulus) *
             ((1 - t) * math.log(1 - t) + t - t**2 / 2))]


# Displacements of test SSNV128 of Code_Aster along the plane at x.
SSNV128 = {0.: 2.86e-2, 1.25: 2.72e-2, 5.: 2.28e-2, 7.5: 1.98e-2}


def ssnv128(result, _):
    """The plane does not move: slips are displacements."""
    slips = {round(p["x"], 9): p["slip_x"] for p in result.points}
    return [(f"u at {x:g}", slips[x], known) for x, known in SSNV128.items()]


def largest(scene, entries, known):
    """Return the largest number that holds in entries(number), by bisection between 0.99 and 1.02
    of the known one. For a larger one the program tells that a body escapes."""
    low, high = .99 * known, 1.02 * known
    for _ in range(12):
        middle = (low + high) / 2
        done = run(scene, entries(middle))
        if done.result is None and "escapes" not in done.message:
            raise RunError(f"{scene}, {middle}: {done.message}")
        low, high = (middle, high) if done.result else (low, middle)
    return low


# Half-width and largest pressure over those of Hertz, and half-width of the stick zone over that
# of the contact, of contrib/studies/spence for a coefficient of friction of 0.3.
SPENCE = .9560, 1.3111, .1774


def spence(result, _):
    """Half-widths end in the middle between two contacts."""
    points = sorted(result.cases["press-19"], key=lambda p: p["x"])

    def end(inside):
        last = max(i for i, p in enumerate(points) if inside(p))
        return (points[last]["x"] + points[last + 1]["x"]) / 2
    radius, modulus = 500., 1000.
    load = 2 * math.fsum(p["force"] for p in points)
    hertz = math.sqrt(4 * load * radius / (math.pi * modulus))
    a = end(lambda p: p["pressure"] > 0)
    return [("a", a, SPENCE[0] * hertz),
            ("largest p", max(p["pressure"] for p in points),
             SPENCE[1] * 2 * load / (math.pi * hertz)),
            ("c/a", end(lambda p: p["friction"] == "stick") / a, SPENCE[2])]


def incline(entries, known):
    """Return the measure of the largest slope and of the force along the incline."""
    def measure(result, _):
        slope = largest("prm/incline.prm", lambda tried: [
            *entries, f"Body block/Body force={tried:.12g}, -1"], known)
        along, against = result.state["contact_force"]
        return [("largest slope", slope, known), ("force along it", -along / against, .299)]
    return measure


def tensions(points, pull):
    """Return (angle from the end, tension behind it) of the contacts of the belt, whose end is
    pulled. Friction acts at radius 1, the tension at 1.005."""
    found, tension, middle = [], pull, 1.005
    for p in sorted(points, key=lambda p: p["x"]):
        angle = math.atan2(p["x"], p["y"])
        tension += (p["traction_y"] * math.sin(angle) -
                    p["traction_x"] * math.cos(angle)) * p["area"] / middle
        found.append((angle, tension))
    return found


def belt(result, _):
    """The tension falls by exp(-mu angle / 1.005) from the end. After the release it grows from
    the end as fast as it falls beyond."""
    pull, release = (tensions(result.cases[name], force)
                     for name, force in (("pull", 1.), ("release", .7)))
    return [("tension at the start", pull[-1][1], math.exp(-.3 * math.pi / 2 / 1.005)),
            ("largest tension", max(tension for _, tension in release), math.sqrt(.7))]


def pulled(ratio):
    """Return entries that pull the belt at both ends, with 1 at its start."""
    return ["Body belt/Supports=", *(
        f"Load case {case}/Pressure=belt.start: -1/0.01, belt.end: -{ratio:.12g}/0.01"
        for case in ("pull", "release"))]


def belt_pulled(result, _):
    """The tension falls from both ends; where it is least, the belt does not slip. The belt slides
    if this place is at the start."""
    quarter = .3 * math.pi / 2 / 1.005
    ratio = largest("prm/belt.prm", pulled, math.exp(quarter))
    return [("least tension", min(tension for _, tension in tensions(result.cases["pull"], 1.3)),
             math.sqrt(1.3) * math.exp(-quarter / 2)),
            ("largest ratio", ratio, math.exp(quarter))]


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


def rigid_against_stiff(result, stiff):
    return [("load", abs(result.state["contact_force"][1]),
             abs(stiff.state["contact_force"][1])),
            ("p0", max(result.pressures()), max(stiff.pressures()))]


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


def crowned_punch(result, _):
    """The answers are the even pressure 1 and the profile of a rigid punch that has it: how far the
    half plane sinks less at x than in the middle (Johnson, 2.5)."""
    points = sorted(result.points, key=lambda p: p["x"])

    def sinking(x):
        return .91 / (1000 * math.pi) * sum(
            s * math.log(s * s) for s in (1 + x, 1 - x) if s > 0)
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


def slip_work(before, after):
    """Return the work of the mean friction forces of two load steps over the slips between them.
    Forces are those on the slave, and slips those of the slave, which they oppose."""
    return -math.fsum((p[f"traction_{x}"] + q[f"traction_{x}"]) / 2 * q["area"] * q[f"slip_{x}"]
                      for p, q in zip(before, after) if q["friction"] != "open"
                      for x in "xyz" if f"slip_{x}" in q)


def stick_radius(points, coefficient):
    """Return the radius of the disc on which the friction forces are below their limit, from the
    second moment of the reserve, which is proportional to (c^2 - r^2)^(1/2)."""
    reserves = [(p["x"]**2 + p["y"]**2, p["area"] * (coefficient * p["pressure"] - math.hypot(
        *(p[f"traction_{x}"] for x in "xyz")))) for p in points]
    return math.sqrt(2.5 * math.fsum(square * reserve for square, reserve in reserves) /
                     math.fsum(reserve for _, reserve in reserves))


class MindlinCycle:
    """This class has the forces, displacements and works of prm/mindlin.prm, of both halves, and
    Mindlin's formulas for them; steps of a quarter of a cycle: 4."""

    coefficient, quarter = .5, 4
    compliance = 2 * (2 - .3) / (1000 / 2.6)  # sum of (2 - nu) / G

    def __init__(self, result):
        states = [case["state"] for case in result.summary["load_cases"]]
        self.steps = list(result.cases.values())
        self.load = 2 * states[0]["contact_force"][2]
        self.radius = (3 * self.load * 4 / (4 * moduli(*EQUAL)))**(1 / 3)
        self.forces = [-2 * state["contact_force"][0] for state in states]
        self.places = [.0022 * 2 / math.pi * math.asin(math.sin(math.pi / 2 * i / self.quarter))
                       for i in range(len(states))]
        self.energies = [2 * state["strain_energy"] for state in states]
        self.dissipations = [2 * state["friction"]["dissipation"] for state in states]
        self.turn = self.forces[self.quarter] / self.limit()
        self.cycle = range(self.quarter + 1, 5 * self.quarter + 1)

    def limit(self):
        return self.coefficient * self.load

    def works(self):
        """Return the work of the tangential force in each step of the cycle: the trapezoids."""
        return [(self.forces[i] + self.forces[i - 1]) / 2 * (self.places[i] - self.places[i - 1])
                for i in self.cycle]

    def slip_works(self):
        return [2 * slip_work(self.steps[i - 1], self.steps[i]) for i in self.cycle]

    def stick(self, step):
        """Return the radius of the disc that sticks over that of the contact, and Mindlin's."""
        full = stick_radius([{**p, "traction_x": 0, "traction_y": 0, "traction_z": 0}
                             for p in self.steps[step]], self.coefficient)
        return (stick_radius(self.steps[step], self.coefficient) / full,
                (1 - self.forces[step] / self.limit())**(1 / 3))

    def displacement(self, force):
        """Return Mindlin's displacement under a first force."""
        return 3 * self.limit() * self.compliance / (16 * self.radius) * (
            1 - (1 - force / self.limit())**(2 / 3))

    def loss(self):
        """Return Mindlin's energy lost in a cycle."""
        t = self.turn
        return 9 * self.limit()**2 * self.compliance / (10 * self.radius) * (
            1 - (1 - t)**(5 / 3) - 5 * t / 6 * (1 + (1 - t)**(2 / 3)))


def mindlin(result, _):
    """Quantities are the radius that sticks at half of the first turning point's displacement and
    there, the area of the loop of force over displacement, and the work of friction in it, which
    is that area less the growth of the strain energy."""
    cycle = MindlinCycle(result)
    area = math.fsum(cycle.works())
    growth = cycle.energies[cycle.cycle[-1]] - cycle.energies[cycle.quarter]
    return [("c/a, step 2", *cycle.stick(2)), ("c/a, step 4", *cycle.stick(4)),
            ("loop", area, cycle.loss()),
            ("friction", math.fsum(cycle.slip_works()), area - growth),
            ("dissipation", math.fsum(cycle.dissipations[i] for i in cycle.cycle), area)]


def press_fit(result, _):
    """The answers are Lame's pressure of rings from 10 to 20 and 20 to 40 that are held inside and
    outside, the torque per turn of rings that stick, and the torque that slides."""
    (a, b, c), E, nu, coefficient, turn = (10., 20., 40.), 210000, .3, .15, 1e-4
    shear = E / (2 * (1 + nu))

    def compliance(fixed):  # of displacements A (r - fixed^2 / r)
        return (b - fixed**2 / b) / (2 * shear * (1 / (1 - 2 * nu) + fixed**2 / b**2))
    pressure = .02 / (compliance(a) - compliance(c))
    stiffness = 4 * math.pi * shear / (1 / a**2 - 1 / c**2)
    largest = coefficient * pressure * 2 * math.pi * b**2
    states = [case["state"] for case in result.summary["load_cases"]]
    steps = len(states) - 1
    return [("pressure", max(result.pressures()), pressure),
            ("torque, step 1", states[1]["responses"]["torque"], stiffness * turn),
            (f"torque, step {steps}", states[-1]["responses"]["torque"], largest),
            ("dissipation", math.fsum(state["friction"]["dissipation"] for state in states),
             largest * (steps * turn - largest / stiffness))]


def press_fit_bore(result, _):
    """No torque is above that of the peak pressure on the whole bore, and the peak is as before."""
    found, start = result.state["responses"], result.summary["initial_state"]["responses"]
    return [("torque", -found["torque"], .15 * found["peak"] * 2 * math.pi * 20**2),
            ("peak", found["peak"], start["peak"])]
