"""Error against the size of steps: chart (a)."""

from runs import RunError, compared, error
from scenes import COMPLIANCE, HEIGHTS_2D, HERTZ_2D, HERTZ_3D, tolerance

SCENES = {"2D Hertz, 9 heights": (HERTZ_2D, HEIGHTS_2D),
          "3D Hertz, 9 heights": (HERTZ_3D, {})}

# Derivatives of the data and overall differences of one run
RUNS = (("forward differences", "forward"), ("central differences", "central"),
        ("refined forward differences", None),
        ("refined central differences", "fourth order"))


def measure(quick):
    """Rows for the file: scene, method, step, errors of dJ and u'."""
    exponents = (4,) if quick else range(1, 11)
    rows = []
    for name, (scene, settings) in list(SCENES.items())[:1 if quick else 2]:
        fixed = {**settings, **COMPLIANCE,
                 **tolerance("1e-10" if quick else "1e-12")}
        for exponent in exponents:
            for derivatives, stencil in RUNS:
                rows += at_step(name, (scene, fixed), exponent, derivatives,
                                stencil)
    return rows


def at_step(name, of, exponent, derivatives, stencil):
    step = f"1e-{exponent}"
    options = {"Derivatives": derivatives, "Semi-analytic step": step,
               "Differences": stencil or "forward",
               "Step": step if stencil else "1e-3"}
    try:
        found = compared(*of, **options)
    except RunError:  # a step too large for the mesh or the contacts
        return []
    exact = found["direct"]["values"]

    def row(method, of_method):
        return {"scene": name, "method": method, "step": float(step),
                "error of dJ": error(of_method["values"], exact),
                "error of u'": of_method["displacement_difference"] or 0.}

    rows = [row("semi-analytic, " + derivatives.replace(" differences", ""),
                found["semi-analytic"])]
    if stencil:
        rows.append(row("overall, " + stencil, found["finite differences"]))
    if derivatives == "forward differences":
        rows.append(row("adjoint against direct", found["adjoint"]))
    return rows
