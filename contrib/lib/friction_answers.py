"""What contrib/gallery measures in its scenes with friction, and the known answers, as
known_answers does."""

import math

from known_answers import EQUAL, moduli
from runs import RunError, run


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
        if done.result is None and "is not held" not in done.message:
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
    Mindlin's formulas for them. A quarter of a cycle has the given number of steps."""

    coefficient = .5
    compliance = 2 * (2 - .3) / (1000 / 2.6)  # sum of (2 - nu) / G

    def __init__(self, result, quarter=4):
        self.quarter = quarter
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
