"""The pictures of doc/gallery that contrib/plot draws, with the known answers of their pressures."""

import collections
import json
import math
import pathlib
import shutil
import subprocess

from known_answers import (CONE, EQUAL, HIP_SECTION, PERFECT_FIT, STIFF, cone_pressure, cone_radius,
                           lame_pressure, moduli, sinking)
from runs import ROOT, RunError, run, solve

# Names of pictures in doc/images with the pictures that contrib/plot draws of a scene with
# entries; options of contrib/plot; known(summary), shape(summary): the name of a known answer, its
# places and pressures, or heights of the shaped face.
Picture = collections.namedtuple("Picture", "scene images entries options known shape",
                                 defaults=[(), (), None, None])


def samples(first, last):
    return [first + (last - first) * i / 200 for i in range(201)]


def force(summary, axis):
    return abs(summary["state"]["contact_force"][axis])


def semi_ellipse(peak, half_width, middle=0., inclination=1.):
    """Return the places and pressures of Hertz along an axis; inclination: the cosine of the angle
    between the axis and the face."""
    places = samples(-1., 1.)
    return ([middle + half_width * inclination * x for x in places],
            [peak * math.sqrt(1. - x * x) for x in places])


def hertz_line(radius, bodies, load, middle=0., inclination=1.):
    """Return the known answer of a line contact; load(summary) per length."""
    def known(summary):
        force_per_length, modulus = load(summary), moduli(*bodies)
        a = math.sqrt(4 * force_per_length * radius / (math.pi * modulus))
        return ("Hertz", *semi_ellipse(2 * force_per_length / (math.pi * a), a, middle,
                                       inclination))
    return known


def hertz_point(radius, bodies, load):
    def known(summary):
        of_all, modulus = load(summary), moduli(*bodies)
        a = (3 * of_all * radius / (4 * modulus))**(1 / 3)
        return ("Hertz", *semi_ellipse(3 * of_all / (2 * math.pi * a**2), a))
    return known


def of_half(summary):
    return 2 * force(summary, 1)


def of_quarter(summary):
    return 4 * force(summary, 2)


def gear_pair(_):
    """Return the pressure of cylinders with the radii of the involutes at the pitch point, along x,
    to which the flanks are inclined by the pressure angle."""
    alpha, radii = math.radians(20), (40., 60.)
    known = hertz_line(math.sin(alpha) / sum(1 / r for r in radii), 2 * ((206000, .3),),
                       lambda _: 1e5 / (40. * math.cos(alpha)) / 10., 40., math.cos(alpha))
    return known(None)


def flat_punch(summary):
    places = [x for x in samples(0., 1.) if x < .9995]
    return ("rigid punch", places,
            [2 * force(summary, 1) / (math.pi * math.sqrt(1 - x * x)) for x in places])


def pin_in_hole(summary):
    """Return the pressure of Persson over the angle, whose bottom is at -90 degrees, of a hole of
    radius 1."""
    load, b = 2 * force(summary, 1), PERFECT_FIT
    r, end = math.sqrt(1 + b * b), 2 * math.atan(b)

    def pressure(angle):
        y = math.tan(angle / 2)
        root = math.sqrt(max(0., b * b - y * y))
        return load * (2 * root / (math.pi * r * (1 + y * y)) +
                       math.log((r + root) / (r - root)) / (2 * math.pi * b * b * r * r))
    places = samples(0., end)
    return ("Persson", [math.degrees(angle) - 90. for angle in places],
            [pressure(angle) for angle in places])


def hip_joint(_):
    """Return the pressure of the joint as a section on a fine mesh."""
    points = sorted((p["x"], p["pressure"]) for p in solve("prm/hip-joint.prm", HIP_SECTION).points)
    return ("section", *zip(*points))


def stiff_sphere(_):
    """Return the pressure under a body with the face of the sphere and a million times the
    modulus."""
    points = sorted((p["x"], p["pressure"]) for p in solve(
        "prm/point-contact-axisymmetric.prm", STIFF).points)
    return ("stiff body", *zip(*points))


def degree_2(_):
    """Return the pressure on the symmetry plane of a solution of degree 2."""
    found = solve("prm/incompressible.prm", ["Element degree=2", *(
        f"Body {body}/Box cells=12, 12, 12" for body in ("upper", "lower"))])
    points = sorted((p["x"], p["pressure"]) for p in found.points if abs(p["y"]) < 1e-9)
    return ("degree 2", *zip(*points))


def sunk_half_plane(_):
    """Return the heights of a rigid punch with even pressure 1 (Johnson, 2.5), along the face of
    half of it."""
    places = samples(0., 1.)
    return "half-plane", places, [-sinking(x) for x in places]


def lundberg(_):
    """Return the heights of Lundberg's profile of a roller of 20 mm at 3000 MPa."""
    places = samples(-9.95, 9.95)
    drop = 20. * (3000. / moduli((206000, .3)))**2
    return "Lundberg", places, [drop * math.log(1. - (x / 10.)**2) for x in places]


def even(value, last, name="even pressure"):
    return lambda _: (name, [0., last], [value, value])


def sneddon(_):
    """Return the pressure under the cone; it is infinite in the middle."""
    a = cone_radius()
    places = [a * x for x in samples(.02, 1.)]
    return "Sneddon", places, [cone_pressure(r, a) for r in places]


def force_over_area(summary):
    value = summary["initial_state"]["responses"]["hold"] / (2 * math.pi * 20 * 15)
    return "force / area", [0., 15.], [value, value]


PRESSURE, STRESS = "contact-pressure.png", "von-mises.png"
SHAPE, CONVERGENCE = "shape.png", "convergence.png"
MEAN = even(100., 1., "force / area")
EXACT = even(1., 2., "exact")

PICTURES = {
    "bolted-flange": Picture("bolted-flange", {"bolted-flange": "tighten/" + STRESS,
                                               "bolted-flange-pressure": "tighten/" + PRESSURE}),
    "bearing-housing": Picture("bearing-housing", {"bearing-housing": STRESS,
                                                   "bearing-housing-pressure": PRESSURE}),
    "block-pair": Picture("block-pair", {"block-pair": STRESS}),
    "bush": Picture("bush", {"bush-push": "push/" + PRESSURE, "bush-pull": "pull/" + PRESSURE,
                             "bush-shape": SHAPE},
                    known=lambda _: ("lower bound of the worst peak", [-90., 90.], [50., 50.])),
    "crowned-punch": Picture("crowned-punch", {"crowned-punch": PRESSURE,
                                               "crowned-punch-shape": SHAPE},
                             known=even(1., 1.), shape=sunk_half_plane),
    "five-bodies": Picture("five-bodies", {"five-bodies": STRESS}),
    "flat-punch": Picture("flat-punch", {"flat-punch": PRESSURE}, known=flat_punch),
    "floating-block": Picture("floating-block", {"floating-block-wedge": STRESS},
                              ["Body block/Curved faces=bottom: -0.02*x"]),
    "gear-cycle": Picture("gear-cycle", {"gear-cycle": "mesh-19/" + STRESS}),
    "gear-pair": Picture("gear-pair", {"gear-pair": STRESS, "gear-pair-pressure": PRESSURE},
                         known=gear_pair),
    "gmsh-pin": Picture("gmsh-pin", {"gmsh-pin": PRESSURE},
                        known=hertz_point(2., [(1000, .3)], of_quarter)),
    "hertz-2d": Picture("hertz-2d", {"hertz-2d": PRESSURE}, known=hertz_line(4., EQUAL, of_half)),
    "hertz-3d-9": Picture("hertz-3d-9", {"hertz-3d-9-pressure": PRESSURE}, known=MEAN),
    "hertz-3d-16": Picture("hertz-3d-16", {"hertz-3d-16-pressure": PRESSURE,
                                           "hertz-3d-16-von-mises": STRESS,
                                           "hertz-3d-16-shape": SHAPE,
                                           "hertz-3d-16-convergence": CONVERGENCE}, known=MEAN),
    "hip-joint": Picture("hip-joint", {"hip-joint": PRESSURE}, known=hip_joint),
    "incline": Picture("incline", {"incline": STRESS}),
    "incompressible": Picture("incompressible", {"incompressible": PRESSURE}, known=degree_2),
    "indenter": Picture("indenter", {"indenter": PRESSURE},
                        known=hertz_point(50., [(3000, .35)], lambda _: 5.)),
    "indenter-cone": Picture("indenter", {"indenter-cone": PRESSURE}, CONE, known=sneddon),
    "leaf-spring": Picture("leaf-spring", {"leaf-spring": STRESS}),
    "nafems-roller": Picture("nafems-roller", {"nafems-roller": STRESS,
                                               "nafems-roller-pressure": PRESSURE},
                             known=hertz_line(50., [(210000, .3), (70000, .3)], of_half)),
    "patch-test-nodal": Picture("patch-test", {"patch-test-nodal": PRESSURE},
                                ["Contact/Method=nodal"], ["--peak", "1.08"], EXACT),
    "patch-test-mortar": Picture("patch-test", {"patch-test-mortar": PRESSURE}, [],
                                 ["--peak", "1.08"], EXACT),
    "peak-pressure": Picture("peak-pressure", {"peak-pressure": PRESSURE,
                                               "peak-pressure-convergence": CONVERGENCE},
                             known=MEAN),
    "pin-in-hole": Picture("pin-in-hole", {"pin-in-hole": PRESSURE}, known=pin_in_hole),
    "point-contact": Picture("point-contact", {"point-contact": PRESSURE},
                             known=hertz_point(4., EQUAL, of_quarter)),
    "press-fit-bore": Picture("press-fit-bore", {"press-fit": PRESSURE}),
    "rigid-sphere": Picture("rigid-sphere", {"rigid-sphere": STRESS,
                                             "rigid-sphere-pressure": PRESSURE},
                            known=stiff_sphere),
    "roller": Picture("roller", {"roller-shape": SHAPE, "roller-pressure": "heavy-2/" + PRESSURE}),
    "roller-profile": Picture("roller-profile", {"roller-profile-shape": SHAPE,
                                                 "roller-profile-pressure": PRESSURE},
                              shape=lundberg),
    "shrink-fit": Picture("shrink-fit", {"shrink-fit": STRESS, "shrink-fit-pressure": PRESSURE},
                          known=even(lame_pressure("plane stress"), 360., "Lamé")),
    "shrunk-hub": Picture("shrunk-hub", {"shrunk-hub": PRESSURE, "shrunk-hub-shape": SHAPE},
                          known=force_over_area),
    "step-punch": Picture("step-punch", {"step-punch": PRESSURE},
                          known=hertz_point(10., [(1000, .3)] * 2, of_quarter)),
    "step-roller": Picture("step-roller", {"step-roller": SHAPE}),
    "two-cylinders": Picture("two-cylinders", {"two-cylinders": STRESS,
                                               "two-cylinders-pressure": PRESSURE},
                             known=hertz_line(1 / (1 / 4 + 1 / 8), [(1000, .3), (4000, .2)],
                                              of_half))}


def draw(name):
    """Run the scene of a picture and write its images into doc/images."""
    picture = PICTURES[name]

    def inspect(directory, _):
        directory = directory.rename(directory.parent / name)  # the name in the titles
        words = [str(ROOT / "contrib/plot"), *picture.options]
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        for option, answer in (("--known", picture.known), ("--known-shape", picture.shape)):
            if answer:
                title, places, values = answer(summary)
                known = directory / f"{option[2:]}.csv"
                known.write_text(f"place,{title}\n" + "".join(
                    f"{place!r},{value!r}\n" for place, value in zip(places, values)))
                words += [option, str(known)]
        subprocess.run([*words, str(directory)], check=True, stdout=subprocess.DEVNULL)
        for image, source in picture.images.items():
            target = pathlib.Path(ROOT / "doc/images" / (image + ".png"))
            shutil.copyfile(directory / source, target)
            print(target.relative_to(ROOT), f"{target.stat().st_size / 1024:.0f} kB", flush=True)
        return True
    # The comment of each of these scenes names its units.
    done = run(f"prm/{picture.scene}.prm", ["Units=mm, N", *picture.entries],
               timeout=3600, inspect=inspect)
    if not done.result:
        raise RunError(f"{picture.scene}: status {done.status}, {done.message}")
