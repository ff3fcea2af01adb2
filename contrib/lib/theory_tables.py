"""Tables of doc/theory.md that contrib/gallery --write remakes."""

from gallery_runs import solve

METIS = ["Decomposition/Method=METIS", "Decomposition/Subdomains=64"]
# In the order of the rows.
WITH_SOFT_MODES = [("hertz-2d", []), ("leaf-spring", []), ("gear-pair", []), ("hip-joint", []),
                   ("gmsh-pin", []), ("point-contact", []), ("point-contact-solid", []),
                   ("hertz-3d-9", METIS), ("hertz-3d-9", [])]


def soft_modes():
    """F-mults without and with soft modes, of a linear solve and from a cold start."""
    for scene, settings in WITH_SOFT_MODES:
        found = [solve(f"prm/{scene}.prm", "Task=state", "Solver/Report linear reference=true",
                       *settings, *others).summary
                 for others in (["Solver/Soft modes=none"], [])]
        modes = found[1]["work"]["soft_modes"]

        def both(key, found=found, modes=modes):
            numbers = [str(run["state"][key]) for run in found]
            return ", ".join(numbers if modes else numbers[:1])
        yield {"subdomains": str(found[1]["mesh"]["subdomains"]), "modes": str(modes or ""),
               "linear": both("linear_f_mults"), "cold": both("f_mults"), "quantities": []}


TABLES = {"soft-modes": soft_modes}
