"""Gear pairs that touch at the pitch point, meshed by Gmsh."""

import functools
import math
import pathlib
import shutil
import subprocess
import tempfile

from runs import ROOT, scene

from cases import Figure, family

MESHES = ROOT / "prm" / "meshes"
E, NU = 206000, .3
WIDTH, MOMENT = 10, 100000


@functools.lru_cache(maxsize=None)
def gmsh(order, **numbers):
    """prm/meshes/gear.geo with these numbers; None without Gmsh."""
    if not shutil.which("gmsh"):
        return None
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "gear.msh"
        words = [word for name, value in numbers.items()
                 for word in ("-setnumber", name, str(value))]
        subprocess.run(["gmsh", "-2", "-order", str(order), "-format", "msh41", *words,
                        str(MESHES / "gear.geo"), "-o", str(file)], check=True,
                       stdout=subprocess.DEVNULL)
        return file.read_bytes()


def hertz(teeth, angle, moment, scale):
    """Tooth force by statics, and the pressure and half width of cylinders with the
    radii of the flanks at the pitch point."""
    r1, r2 = (2 * z * scale for z in teeth)  # module 4
    alpha = math.radians(angle)
    force = moment / (r1 * math.cos(alpha))
    radius = math.sin(alpha) * r1 * r2 / (r1 + r2)
    modulus = E / (2 * (1 - NU**2))
    p0 = math.sqrt(force / WIDTH * modulus / (math.pi * radius))
    return force, p0, 2 * force / WIDTH / (math.pi * p0)


def off_the_ellipse(result, pitch, p0, a):
    """The worst node of the inner 0.7 of the half width."""
    worst = 0.
    for point in result.points:
        s = math.hypot(point["x"] - pitch, point["y"]) / a
        if s < .7:
            worst = max(worst, abs(point["pressure"] / p0 / math.sqrt(1 - s * s) - 1))
    return worst


@family("gears", "order {order}")
def gears(order=2, teeth=(20, 30), angle=20, moment=MOMENT, scale=1, swapped=False, quads=False,
          fine=None, degree=None, refinements=None, method=None, slave=None, subdomains=None):
    """The largest pressure is within 2 % of Hertz, with linear elements of the mesh as it is
    within 3 %; the tooth force is as near as the splines of the flanks are to involutes."""
    numbers = {"z1": teeth[0], "z2": teeth[1], "angle": angle, "quads": int(quads),
               **({"fine": fine} if fine else {})}
    shipped = order == 2 and (teeth, angle, quads, fine) == ((20, 30), 20, False, None)
    around = {"Mesh": "file", "Mesh file": "mesh.msh", "Young's modulus": E,
              "Scale": scale, "Refinements": refinements or 0}
    bodies = {name: {"Mesh regions": name, **around} for name in ("pinion", "wheel")}
    turned, held = ("wheel", "pinion") if swapped else ("pinion", "wheel")
    own = moment * teeth[1] / teeth[0] if swapped else moment
    bodies[turned].update({"Supports": f"{turned}_bore: normal",
                           "Moment": f"{turned}_bore: {own}"})
    bodies[held]["Supports"] = f"{held}_bore: xy"
    text = scene(bodies, {"Pairs": "pinion.pinion_flank: wheel.wheel_flank",
                          "Search distance": scale, "Method": method or "auto",
                          "Slave": slave or "finer"},
                 {"Subdomains": subdomains or "auto"}, Dimension=2, Thickness=WIDTH,
                 Element_degree=degree or 1)
    force, p0, a = hertz(teeth, angle, moment, scale)
    bound = 2e-2 if order == 2 or degree or refinements else 3e-2

    def asked(result):
        off = off_the_ellipse(result, 2 * teeth[0] * scale, p0, a)
        return [Figure("largest p", result.state["max_pressure"], p0, bound),
                Figure("p off Hertz' ellipse", off, 0., 8e-2),
                Figure("tooth force", math.hypot(*result.state["contact_force"]), force, 2e-4)]
    return text, asked, ((MESHES / "gear.msh").read_bytes if shipped else
                         functools.partial(gmsh, order, **numbers))


GEARS = [
    gears(),
    gears(subdomains=1),
    gears(degree=2, ranks=2),
    gears(order=1),
    gears(order=1, refinements=1),
    gears(order=1, degree=2),
    gears(refinements=1, ranks=3),
    gears(order=1, quads=True),
    gears(quads=True, ranks=4),
    gears(teeth=(17, 43)),
    gears(teeth=(25, 25), order=1),
    gears(teeth=(30, 20), degree=2),
    gears(teeth=(20, 80), ranks=2),
    gears(angle=25),
    gears(swapped=True),
    gears(swapped=True, order=1, degree=2, subdomains=3),
    gears(moment=50000, fine=.04),
    gears(moment=200000, order=1),
    gears(scale=.001, moment=.1),
    gears(method="mortar", slave="first", subdomains=13),
    gears(fine=.03, order=1, ranks=4),
]
