"""The small scenes whose meshes are made for targets of accuracy."""

import math

import known_answers
from measures import Below, Check, at, same, values
from runs import solve

PEAK = "Accuracy/Target=peak pressure: 1 %"
BY_DEGREE_2 = ["Element degree=2", "Solver/Relative tolerance=1e-9"]
MET = {"accuracy.met": 1.}

# By much finer meshes of degree 2; Hertz' largest pressure.
ADAPTED = values({"state.energy": -7.8345e-5, "state.max_pressure": math.sqrt(
    0.25 * 1000 / (2 * (1 - .3**2)) / (math.pi * 4))})
# Exponent 8, by much finer meshes; uniform ones take 66,000 unknowns.
ADAPTED_PEAK = values({"accuracy.meshes.-1.responses.peak pressure.value": 3.0258,
                       "mesh.dofs": Below(1000)})
# Cells of equal size stay near the contact; to the end of the side it were 26,864.
UNLIKE_MESHES = values({"mesh.dofs": Below(10000), "state.energy": -14680.8})
# By a mesh for 0.02 % of degree 2.
NEARLY_INCOMPRESSIBLE = values({**MET, "state.responses.pk": 24.4806, "mesh.dofs": Below(8000)})
# F L^3 / 192 E' I in the middle of a beam that both ends hold.
THIN_PLATE = values({**MET, "state.responses.tip": -20**3 / (
    192 * 200000 / (1 - .3**2) * .1**3 / 12)})
# Of degree 2, to 1 %, with the tip as well.
THIN_PLATE_PEAK = values({**MET, "state.responses.peak": 76.27})


def jumping_load(result, _):
    """Half of the top is loaded and a bit more, which ends within a face."""
    force = at(result, "accuracy.meshes.-1.responses.contact force")
    return [("force", force["value"], .125 * .53),
            ("estimated error", force["error"], Below(.01 * force["value"]))]


def verified(result, _):
    found = result.summary["accuracy"]["verified"]["potential energy"]
    return [("verified error", found["error"], Below(0.01 * abs(found["value"])))]


def more_meshes(*results):
    found, beside = (len(one.summary["accuracy"]["meshes"]) for one in results)
    return [("meshes beside", beside, Below(found))]


def estimates(right):
    """Return the measure that estimates are errors; right: values by response."""
    def measure(result, _):
        found = {"potential energy": result.state["energy"], **result.state["responses"]}
        return [(f"estimate over error, {name}",
                 result.state["accuracy"]["responses"][name] / abs(value - found[name]), 1.)
                for name, value in right.items()]
    return measure


# prm/shrink-fit.prm: the energy is the pressure times the interference times half of the
# circumference, in which the mismatch of both polygons is the largest part of the error.
PRESSURE = known_answers.lame_pressure("plane stress")
UNLIKE_RINGS = estimates({"potential energy": PRESSURE * .002 * 2 * math.pi,
                          "force": PRESSURE * 4 * math.pi})
# tests/scenes/lame-sphere.prm: half of the pressures times the interferences times an eighth of
# the sphere.
CAVITY, SHELL = known_answers.lame_spheres()
ROUND_SOLIDS = estimates({"potential energy": (CAVITY * .002**2 + SHELL * .001**2) * math.pi / 4})
# Half of pressure times strain times the volume, and nothing strained unevenly: what the mesh
# lacks is volume.
PRESSED_BALL = estimates({"potential energy": -.5 * 3 * (1 - 2 * .3) / 1000 * math.pi / 6})


def on_fine_faces(design):
    """Return the peak of edge-2d's design on faces of 1/512 mm twice as far as there is contact."""
    fine = solve("tests/scenes/edge-2d.prm", [
        "Task=state", "Accuracy/Target=", f"Shape/Initial={design[0]!r}",
        *(f"Body {name}/{entry}" for name in ("cylinder", "plane") for entry in (
            "Local refinements=6", "Refine where=0.2 - sqrt(x^2 + (y - 1)^2)"))])
    return fine.state["responses"]["peak"]


def promise(result, _):
    """On one coarse mesh most of what it gains is not there on a fine one."""
    found = result.summary["optimization"]
    before, after = (on_fine_faces(x) for x in ([0.], found["design"]))
    return [("peak it says", found["objective_final"], Below(.8 * before)),
            ("four fifths of the fine one", .8 * before, Below(after))]


def kept_promise(result, _):
    """To the target the fine mesh agrees, and the gain is worth its name."""
    found = result.summary["optimization"]
    fine = on_fine_faces(found["design"])
    error = result.summary["accuracy"]["verified"]["peak"]["error"]
    return [("peak", found["gain"]["final"], fine),
            ("verified error", error, Below(.03 * fine)),
            ("last peak", found["gain"]["final"], Below(.9 * found["gain"]["initial"])),
            ("counts", float(found["gain"]["counts"]), 1.)]


def warned(result, words):
    """Return the quantity that a warning has these words."""
    return (f"warns: {words}", float(any(words in line for line in result.summary["warnings"])),
            1.)


def no_gain(result, _):
    """Within tight bounds the gain is smaller than the error, which is said."""
    gain = result.summary["optimization"]["gain"]
    return [("gain", gain["initial"] - gain["final"], Below(gain["final_error"])),
            ("does not count", 1. - gain["counts"], 1.),
            warned(result, "smaller than its estimated error")]


def lifted(result, _):
    """The last mesh warns of what would be an error of the first."""
    return [("peak, by degree 2 for 0.1 %", result.state["responses"]["peak"], 9.1338),
            ("met", at(result, "accuracy.met"), 1.), warned(result, "initial penetration")]


CHECKS = [
    Check("adapted-2d", ["Accuracy/Target=contact force: 1 %", "Accuracy/Verify=false",
                         "Body cylinder/Pressure=top: .125*(x<.53)"], jumping_load, 1e-2),
    Check("adapted-2d", [], ADAPTED, 1e-2),
    Check("adapted-2d", [PEAK], ADAPTED_PEAK, 1e-2),
    Check("adapted-2d", ["Accuracy/Verify=true"], verified, 1e-2),
    *(Check("adapted-2d", [entry, PEAK], more_meshes, 0., [PEAK])
      for entry in ("Accuracy/Marking share=0.3", "Accuracy/Contact faces=20")),
    Check("adapted-2d", ["Accuracy/Maximum levels=10", "Accuracy/Maximum unknowns=1000"],
          same("state.energy"), 1e-12, []),
    Check("../../prm/nafems-roller",
          ["Accuracy/Target=potential energy: 0.1 %", "Body roller/Local refinements=0",
           "Body block/Local refinements=0", "Body block/Box cells=20, 20"],
          UNLIKE_MESHES, 1e-3),
    Check("edge-2d", ["Accuracy/Target="], promise, 0.),
    Check("edge-2d", ["Accuracy/Target=peak: 3 %"], kept_promise, 1e-2),
    Check("edge-2d", ["Shape/Bounds=-1e-6, 1e-6"], no_gain, 1e-12),
    *(Check("../../prm/shrink-fit", [
        "Accuracy/Estimate=responses", f"Body inner/Cells={inner}, 6",
        f"Body outer/Cells={outer}, 6", "Responses=force",
        "Response force/Quantity=contact force"], UNLIKE_RINGS, .05)
      for inner, outer in ((32, 40), (40, 32), (32, 32))),
    *(Check("pressed-ball", entries, PRESSED_BALL, .01)
      for entries in ([], ["Body ball/Cells=7"], BY_DEGREE_2)),
    *(Check("nearly-incompressible-target", entries, NEARLY_INCOMPRESSIBLE, 5e-3)
      for entries in ([], ["Element degree=2"], ["Contact/Method=mortar"])),
    Check("thin-plate-target", [], THIN_PLATE, .05),
    Check("thin-plate-target", ["Accuracy/Target=peak: 20 %"], THIN_PLATE_PEAK, .2),
    Check("lifted-target", ["Task=state"], lifted, .03),
    *(Check("lame-sphere", ["Accuracy/Estimate=responses", *entries], ROUND_SOLIDS, .25)
      for entries in ([], [*BY_DEGREE_2, "Body ball/Cells=4", "Body shell/Cells=4, 4"],
                      ["Body pearl/Cells=6", "Body ball/Cells=4", "Body shell/Cells=4, 3"])),
]
