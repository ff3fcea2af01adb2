"""Error against the tolerance of the state: chart (d)."""

from runs import compared, error
from scenes import HERTZ_3D, tolerance


def measure(quick):
    """Rows for the file: tolerance, method, error of dJ."""
    rows = []
    for objective in ("compliance", "potential energy"):
        chosen = {"Optimization/Objective": objective}
        exact = compared(HERTZ_3D, {**chosen, **tolerance("1e-13")})
        reference = exact["direct"]["values"]
        for exponent in (6,) if quick else range(2, 13):
            given = {**chosen, **tolerance(f"1e-{exponent}")}
            found = {}
            for stencil in ("forward", "central"):
                by_method = compared(HERTZ_3D, given, Differences=stencil,
                                     Step="1e-4")
                differences = by_method.pop("finite differences")
                found.update(by_method)
                found[f"overall, {stencil}"] = differences
            for method, row in found.items():
                if (objective == "compliance") == (method != "energy"):
                    rows.append({"tolerance": 10.**-exponent, "method": method,
                                 "error of dJ": error(row["values"],
                                                      reference)})
    return rows
