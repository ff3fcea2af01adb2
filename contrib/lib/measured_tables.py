"""The tables of doc/choices.md that contrib/gallery --write renews."""

import runpy

from runs import ROOT, solve

METIS = ["Decomposition/Method=METIS", "Decomposition/Subdomains=64"]
# In the order of the rows.
WITH_SOFT_MODES = [("hertz-2d", []), ("leaf-spring", []), ("gear-pair", []), ("hip-joint", []),
                   ("gmsh-pin", []), ("point-contact", []), ("point-contact-solid", []),
                   ("hertz-3d-9", METIS), ("hertz-3d-9", [])]


def soft_modes():
    """Yield F-mults without and with soft modes, of a linear solve and from a cold start."""
    for scene, settings in WITH_SOFT_MODES:
        found = [solve(f"prm/{scene}.prm", ["Task=state", "Solver/Report linear reference=true",
                                                *settings, *others]).summary
                 for others in (["Solver/Soft modes=none"], [])]
        modes = found[1]["work"]["soft_modes"]

        def both(key, found=found, modes=modes):
            numbers = [str(run["state"][key]) for run in found]
            return ", ".join(numbers if modes else numbers[:1])
        yield {"subdomains": str(found[1]["mesh"]["subdomains"]), "modes": str(modes or ""),
               "linear": both("linear_f_mults"), "cold": both("f_mults"), "quantities": []}


def targets():
    """Yield targets of 1 % of all scenes of the study."""
    study = runpy.run_path(str(ROOT / "contrib/studies/targets"))
    for name in study["SCENES"]:
        for _, _, _, meshes, unknowns, _, estimated, true in study["rows"](name, [1]):
            yield {"meshes": str(meshes), "unknowns": f"{unknowns:,}",
                   "estimated": f"{estimated:.2f} %", "true": f"{true:.2f} %", "quantities": []}


TABLES = {"soft-modes": soft_modes, "targets": targets}
