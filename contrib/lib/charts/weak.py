"""Across a weakly active contact: chart (e)."""

from runs import compared, gradient, run
from scenes import BLOCKS, COMPLIANCE, tolerance

PRESSURE = 20.  # near which a contact is to open
SETTINGS = {**COMPLIANCE, **tolerance("1e-13"), "Shape/Control points": "4"}


def forces(pressure):
    points = run(BLOCKS, {**SETTINGS, "Task": "state",
                          "Body upper/Pressure": f"top: {pressure!r}"},
                 points=True)
    return [point["force"] for point in points]


def vanishing(pressure, below):
    """Per contact the load at which its force vanishes, from those at two loads: as
    long as contacts stay what they are, forces are linear in the load."""
    loads = []
    for now, before in zip(forces(pressure), forces(below)):
        slope = (now - before) / (pressure - below)
        loads.append(pressure - now / slope if now > 0. and slope > 0. else 0.)
    return loads


def weakening_pressure():
    """The load at which a contact has neither force nor gap. The nearer, the more
    digits of its force count."""
    loads = vanishing(PRESSURE, 0.999 * PRESSURE)
    contact = loads.index(max(loads))
    load = loads[contact]
    for distance in (1e-3, 1e-6):
        load = vanishing((1. + 2. * distance) * load,
                         (1. + distance) * load)[contact]
    return load


def under(pressure):
    return {**SETTINGS, "Body upper/Pressure": f"top: {pressure!r}"}


def measure_sides(load):
    """Rows for the file: per variable, all derivatives at the weak contact."""
    by_stencil = {stencil: compared(BLOCKS, under(load), Differences=stencil,
                                    Step="1e-5")
                  for stencil in ("forward", "backward", "central")}
    found = by_stencil["central"]

    def column(method, stencil="central"):
        return by_stencil[stencil][method]["values"]

    return [{"variable": j,
             "QP, up": column("one-sided, up")[j],
             "differences, up": column("finite differences", "forward")[j],
             "QP, down": column("one-sided, down")[j],
             "differences, down": column("finite differences", "backward")[j],
             "strong set": column("adjoint")[j],
             "central differences": column("finite differences")[j]}
            for j in range(len(found["adjoint"]["values"]))]


def measure_path(load, j, quick):
    """Rows for the file: derivatives by variable j at loads about the weak one."""
    places = (-1, 1) if quick else [0.1 * k for k in range(-10, 11) if k != 0]
    rows = []
    for place in places:
        row = {"load": 0.02 * place}
        for name, method, objective in (
                ("compliance", "adjoint", "compliance"),
                ("energy", "energy", "potential energy")):
            row[name] = gradient(
                BLOCKS, {**under((1. + row["load"]) * load),
                         "Optimization/Objective": objective},
                method)["gradient"]["values"][j]
        rows.append(row)
    return rows


def measure(quick):
    """Both tables and the row of the variable whose derivatives differ most."""
    load = weakening_pressure()
    sides = measure_sides(load)
    widest = max(sides, key=lambda row: abs(row["QP, up"] - row["QP, down"]))
    return sides, measure_path(load, widest["variable"], quick), widest
