"""Gear pairs that touch at the pitch point, on the mesh of prm/gear-pair.prm."""

import math

from runs import ROOT

from cases import Figure, contact_scene, family

MESH = ROOT / "prm" / "meshes" / "gear.msh"
E, NU = 206000, .3
WIDTH, MOMENT, TEETH, MODULE = 10, 100000, (20, 30), 4
ALPHA = math.radians(20)


def hertz(moment, scale):
    """Return the tooth force by statics, and the pressure and half width of cylinders with the
    radii of the flanks at the pitch point."""
    r1, r2 = (MODULE / 2 * z * scale for z in TEETH)
    force = moment / (r1 * math.cos(ALPHA))
    radius = math.sin(ALPHA) * r1 * r2 / (r1 + r2)
    modulus = E / (2 * (1 - NU**2))
    p0 = math.sqrt(force / WIDTH * modulus / (math.pi * radius))
    return force, p0, 2 * force / WIDTH / (math.pi * p0)


def off_the_ellipse(result, pitch, p0, a):
    """Return the error of the worst node of the inner 0.7 of the half width."""
    places = [(math.hypot(p["x"] - pitch, p["y"]) / a, p["pressure"]) for p in result.points]
    return max((abs(pressure / p0 / math.sqrt(1 - s * s) - 1)
                for s, pressure in places if s < .7), default=math.inf)


@family("gears", "degree {degree}")
def gears(degree=1, moment=MOMENT, scale=1, swapped=False, refinements=0, **settings):
    """The largest pressure is within 2 % of Hertz; the tooth force is as near as the splines of
    the flanks are to involutes."""
    around = {"Mesh": "file", "File": "mesh.msh", "Young's modulus": E, "Scale": scale,
              "Refinements": refinements}
    bodies = {name: {"Mesh regions": name, **around} for name in ("pinion", "wheel")}
    turned, held = ("wheel", "pinion") if swapped else ("pinion", "wheel")
    own = moment * TEETH[1] / TEETH[0] if swapped else moment
    bodies[turned].update({"Supports": f"{turned}_bore: normal",
                           "Moment": f"{turned}_bore: {own}"})
    bodies[held]["Supports"] = f"{held}_bore: xy"
    text = contact_scene(bodies, {"Pairs": "pinion.pinion_flank: wheel.wheel_flank",
                                  "Search distance": scale}, degree, Dimension=2, Thickness=WIDTH,
                         **settings)
    force, p0, a = hertz(moment, scale)

    def asked(result):
        off = off_the_ellipse(result, MODULE / 2 * TEETH[0] * scale, p0, a)
        return [Figure("largest p", result.state["max_pressure"], p0, 2e-2),
                Figure("p off Hertz' ellipse", off, 0., 8e-2),
                Figure("tooth force", math.hypot(*result.state["contact_force"]), force, 2e-4)]
    return text, asked, MESH.read_bytes


GEARS = [
    gears(),
    gears(subdomains=1),
    gears(degree=2, ranks=2),
    gears(refinements=1, ranks=3),
    gears(swapped=True),
    gears(swapped=True, degree=2, subdomains=3),
    gears(moment=50000, refinements=1),
    gears(moment=200000),
    gears(scale=.001, moment=.1),
    gears(method="mortar", slave="first", subdomains=13),
]
