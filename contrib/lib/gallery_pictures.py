"""The pictures of doc/gallery that contrib/plot draws, with the known answers of their pressures."""

import collections
import json
import math
import pathlib
import shutil
import subprocess

from known_answers import EQUAL, HIP_SECTION, PERFECT_FIT, moduli
from runs import ROOT, RunError, run, solve

# Names of pictures in doc/images with the pictures that contrib/plot draws of a scene with
# entries; options of contrib/plot; known(summary): the name of a known answer, its places and
# pressures.
Picture = collections.namedtuple("Picture", "scene images entries options known",
                                 defaults=[(), (), None])


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


def even(value, last, name="even pressure"):
    return lambda _: (name, [0., last], [value, value])


def force_over_area(summary):
    value = summary["initial_state"]["responses"]["hold"] / (2 * math.pi * 20 * 15)
    return "force / area", [0., 15.], [value, value]


PRESSURE, STRESS = "contact-pressure.png", "von-mises.png"
SHAPE, CONVERGENCE = "shape.png", "convergence.png"
MEAN = even(100., 1., "force / area")

PICTURES = {
    "block-pair": Picture("block-pair", {"block-pair": STRESS}),
    "bush": Picture("bush", {"bush-push": "push/" + PRESSURE, "bush-pull": "pull/" + PRESSURE,
                             "bush-shape": SHAPE}),
    "crowned-punch": Picture("crowned-punch", {"crowned-punch": PRESSURE,
                                               "crowned-punch-shape": SHAPE},
                             known=even(1., 1.)),
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
    "incompressible": Picture("incompressible", {"incompressible": PRESSURE}),
    "leaf-spring": Picture("leaf-spring", {"leaf-spring": STRESS}),
    "nafems-roller": Picture("nafems-roller", {"nafems-roller": STRESS,
                                               "nafems-roller-pressure": PRESSURE},
                             known=hertz_line(50., [(210000, .3), (70000, .3)], of_half)),
    "patch-test-nodal": Picture("patch-test", {"patch-test-nodal": PRESSURE},
                                ["Contact/Method=nodal"], ["--peak", "1.08"]),
    "patch-test-mortar": Picture("patch-test", {"patch-test-mortar": PRESSURE}, [],
                                 ["--peak", "1.08"]),
    "peak-pressure": Picture("peak-pressure", {"peak-pressure": PRESSURE,
                                               "peak-pressure-convergence": CONVERGENCE},
                             known=MEAN),
    "pin-in-hole": Picture("pin-in-hole", {"pin-in-hole": PRESSURE}, known=pin_in_hole),
    "point-contact": Picture("point-contact", {"point-contact": PRESSURE},
                             known=hertz_point(4., EQUAL, of_quarter)),
    "press-fit-bore": Picture("press-fit-bore", {"press-fit": PRESSURE}),
    "rigid-sphere": Picture("rigid-sphere", {"rigid-sphere": STRESS}),
    "shrink-fit": Picture("shrink-fit", {"shrink-fit": STRESS}),
    "shrunk-hub": Picture("shrunk-hub", {"shrunk-hub": PRESSURE, "shrunk-hub-shape": SHAPE},
                          known=force_over_area),
    "two-cylinders": Picture("two-cylinders", {"two-cylinders": STRESS,
                                               "two-cylinders-pressure": PRESSURE},
                             known=hertz_line(1 / (1 / 4 + 1 / 8), [(1000, .3), (4000, .2)],
                                              of_half))}


def draw(name):
    """Run the scene of a picture and write its images into doc/images."""
    picture = PICTURES[name]

    def inspect(directory, _):
        words = [str(ROOT / "contrib/plot"), *picture.options]
        if picture.known:
            title, places, values = picture.known(
                json.loads((directory / "summary.json").read_text(encoding="utf-8")))
            known = directory / "known.csv"
            known.write_text(f"place,{title}\n" + "".join(
                f"{place!r},{value!r}\n" for place, value in zip(places, values)))
            words += ["--known", str(known)]
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
