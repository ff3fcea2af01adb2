"""The charts of precision: files, pictures and tables of what precision.py measures."""

import functools
import math

import drawing

import peers
import precision
from common import by, curves, legend_below, numbers, panels
from runs import print_table

TITLES = {
    "line": "Line contact, half width 0.05 of the body",
    "wide": "Line contact, half width 0.2 of the body",
    "solid": "Point contact of a quarter in 3D, radius 0.23 of the body",
    "section": "Axisymmetric point contact, radius 0.23 of the body",
    "punch": "Flat punch", "fit": "Shrink fit", "pin": "Pin in a hole",
    "tolerance": "Tolerance of the forces, on the mesh 'by hand, degree 1, 16' of the line contact"}
LABELS = {"seconds": "CPU seconds", "tolerance": "relative tolerance"}


def front(rows, x):
    """Return the rows that nothing else beats in both, in the order of x."""
    best, kept = math.inf, []
    for row in sorted(rows, key=lambda row: (row[x], row["error"])):
        if row["error"] < best:
            best = row["error"]
            kept.append(row)
    return kept


def cheapest(rows, limit):
    """Return the quickest row with an error below the limit, as have all finer ones of its
    series: an error may cross zero by luck."""
    able = []
    for group in by(rows, "series").values():
        good = []
        for row in reversed(group):
            if not row["error"] <= limit:
                break
            good.append(row)
        able += good[-1:]
    if not able:
        return "not reached"
    row = min(able, key=lambda row: row["seconds"])
    return f"{row['series']}, {row['mesh']}: {row['unknowns']} unknowns, {row['seconds']:.2g} s"


def errors(rows, all_runs):
    """Return the rows of a table: all runs or the last one of each series."""
    table = []
    for series, group in by(rows, "series").items():
        for mesh, run in list(by(group, "mesh").items())[0 if all_runs else -1:]:
            table.append({"run" if all_runs else "finest of": series, "mesh": mesh,
                          "unknowns": run[0]["unknowns"], "F-mults": run[0]["F-mults"],
                          "seconds": f"{run[0]['seconds']:.2g}",
                          **{row["quantity"]: f"{row['error']:.1e}" for row in run}})
    return table


def draw_panels(name, rows):
    """Draw the error of the largest pressure, or of the displacement if it is infinite, over
    both costs. The table has the other quantities."""
    scene = precision.SCENES[name]()
    quantities = by(rows, "quantity")
    quantity = "peak pressure" if "peak pressure" in quantities else "displacement"
    group, order = quantities[quantity], list(by(rows, "series"))
    figure, axes = panels(2)
    for axis, x in zip(axes, scene.axes):
        curves(axis, group, "series", x, "error", order)
        if "unknowns" in scene.axes:
            best = front(group, x)
            axis.plot([row[x] for row in best], [row["error"] for row in best], "ko",
                      markersize=9, fillstyle="none", label="best of all")
        axis.set_xscale("linear" if x == "F-mults" else "log")
        axis.set_xlabel(LABELS.get(x, x))
        axis.set_ylabel(f"relative error of the {quantity}")
        if unsure := group[0]["estimate"]:
            low, high = axis.get_ylim()
            axis.axhspan(low / 10., unsure, color="0.9", zorder=0,
                         label="estimated error of the reference")
            axis.set_ylim(low, high)
    figure.suptitle(TITLES[name])
    legend_below(figure, axes, 4, .14)
    return figure


def print_tables(rows, table, failures):
    """Print the answers, and who reaches them; the finest runs; what was not solved."""
    groups = by(rows, "quantity")
    if "tolerance" in rows[0]:
        print_table(errors(rows, True))
        return
    print_table([{
        "quantity": row["quantity"], "reference": f"{row['value']:.6g}",
        "estimated error": f"{row['estimate']:.1e}" if row["estimate"] else "",
        "closed form": f"{row['closed form']:.6g}" if row["closed form"] else "",
        "reference over it": f"{row['value'] / row['closed form'] - 1:+.2%}"
        if row["closed form"] else "",
        **{f"to {100 * limit:g} %": cheapest(groups[row["quantity"]], limit)
           for limit in (.01, .001)}} for row in table])
    print()
    print_table(errors(rows, False))
    print(*failures, sep="\n")


def draw(name, output, quick):
    others = []

    def measured():
        rows, *rest = precision.measure(name, quick)
        others.extend(rest)
        return rows
    rows = numbers(output / f"precision-{name}.csv", measured)
    drawing.save(draw_panels(name, rows), output, f"precision-{name}.png")
    if others:
        print_tables(rows, *others)


CHARTS = {**{name: functools.partial(draw, name) for name in precision.SCENES},
          "peers": peers.draw}
