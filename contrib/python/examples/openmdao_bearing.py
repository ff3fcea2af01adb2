"""Maximize the rating life of a roller in an OpenMDAO group.

The group consists of Snug, whose eight variables shape the profile of a roller under three loads and a
tilt, and of the life of the rolling contact. Lundberg and Palmgren (Dynamic capacity of rolling
bearings, 1947) have L ~ 1 / load^4 for line contacts. With slices as in ISO/TS 16281 and the
pressures of Hertz this is L ~ N^(-64/9), where N is the 8-norm of the contact pressure
(doc/gallery/roller.md). The damages of the load cases are added with their parts of the revolutions
(Miner). The life is compared with that of the logarithmic profile of Lundberg on the same mesh.
"""

import pathlib
import sys

import numpy as np
import openmdao.api as om

import snug
from snug.openmdao import SnugComp

SCENE = pathlib.Path(__file__).resolve().parents[3] / "prm" / "roller.prm"
PARTS = {"light": .6, "middle": .3, "heavy": .1}  # of the revolutions
SETTINGS = {"Responses": "norm, peak", "Response norm/Quantity": "pressure norm",
            "Optimization/Objective": "norm", "Shape/Bounds": [-.02, .02],
            "Body block/Box cells": [24, 3, 2] if "--quick" in sys.argv else [48, 6, 4]}
for case in PARTS:  # the largest tilt alone
    SETTINGS[f"Load case {case}/Cases"] = 1
    SETTINGS[f"Load case {case}/Position"] = "race: rotate y 0.0286478"
# Lundberg's drop in mm with A = R (p0 / E*)^2, along its tangent from 8.8543, and the end radius of 6.
A, END = 20. * (3000. * .91 / 206000.) ** 2, 8.8543
LUNDBERG = (f"{-A}*log(1-(min(abs(x),{END})/9)^2)+{2. * A * END / (81. - END ** 2)}*max(0,abs(x)-{END})"
            f"+max(0,abs(x)-{END})^2/12")

with snug.Model(SCENE, SETTINGS) as model:
    norms = {f"{case}_norm": {"val": 3000.} for case in PARTS}  # [N/mm^2 mm^(1/4)]
    damage = "+".join(f"{part}*({case}_norm/3000)**(64/9)" for case, part in PARTS.items())
    problem = om.Problem(reports=False)
    problem.model.add_subsystem("snug", SnugComp(
        model=model, responses=[f"{case}.norm" for case in PARTS]), promotes=["*"])
    problem.model.add_subsystem("life", om.ExecComp(  # life 1 at a norm of 3000
        f"log_life = -log({damage})", do_coloring=False, **norms), promotes=["*"])
    problem.model.add_design_var("x", lower=model.lower, upper=model.upper, ref=model.scale[0])
    problem.model.add_objective("log_life", scaler=-1.)
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-6, disp=False)
    problem.setup()

    def life():
        problem.run_model()
        return np.exp(problem.get_val("log_life")[0])

    lives = {"straight": life()}
    partials = problem.check_partials(out_stream=None, form="central", step=1e-6)["snug"]
    error = max(np.abs(part["J_fwd"] - part["J_fd"]).max() / np.abs(part["J_fwd"]).max()
                for part in partials.values())
    before = model.process.n
    problem.run_driver()
    requests = model.process.n - before
    lives["optimized"] = life()
    model.set({"Contact/Gap": LUNDBERG})
    problem.set_val("x", 0.)
    lives["Lundberg"] = life()
print(", ".join(f"{name}: life {value:.3g}" for name, value in lives.items()))
print(f"{requests} requests, largest relative error of the partial derivatives {error:.1e}")
assert error < 1e-4, "the derivatives must be those of differences"
assert lives["optimized"] > lives["Lundberg"] > 5. * lives["straight"], "the lives must increase"
