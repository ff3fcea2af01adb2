"""The charts of designs: files, pictures and tables of what design.py measures."""

import drawing  # first: it chooses pictures without a display

import design
from gradient_charts import add_legend, by, curves, panels
from runs import print_table, write_csv


def draw_variables(output, quick):
    rows = design.measure_variables(quick)
    write_csv(output / "design-variables.csv", rows)
    figure, axes = panels(3)
    seconds, f_mults, errors = axes[0]
    order = list(by(rows, "method"))
    state = by(rows, "method")["adjoint"]
    seconds.loglog([row["variables"] for row in state],
                   [row["seconds of the state"] for row in state], "k--", label="the state")
    for axis, y in ((seconds, "seconds"), (f_mults, "F-mults")):
        curves(axis, [row for row in rows if row[y] > 0], "method", "variables", y, order)
        axis.set_ylabel(f"{'CPU ' if axis is seconds else ''}{y} of the gradient")
        counts = sorted(by(rows, "variables"))
        axis.set_xticks(counts, [str(count) for count in counts])
        axis.minorticks_off()
    curves(errors, rows, "method", "seconds", "error of dJ", order)
    errors.set_xlabel("CPU seconds of the gradient")
    errors.set_ylabel("relative error of dJ, 1 to 256 variables")
    figure.suptitle("Gradients against the number of variables; states solved to 1e-6")
    add_legend(errors, *seconds.get_legend_handles_labels())
    drawing.save(figure, output, "design-variables.png")
    print_table([{key: row[key] for key in ("method", "variables", "F-mults", "states",
                                            "seconds", "error of dJ")} for row in rows
                 if quick or row["variables"] != 4])


def draw_searches(output, quick):
    rows, table = design.measure_searches(quick)
    write_csv(output / "design-searches.csv", rows)
    seconds = [row["seconds"] for row in rows]
    figure, axes = panels(2, 5.)
    for axis, (picture, group) in zip(axes[0], by(rows, "picture").items()):
        curves(axis, group, "search", "seconds", "distance")
        axis.set_title(picture, fontsize="medium")
        axis.set_xlabel("CPU seconds of the search")
        axis.set_ylabel("objective above the best, relative to the first")
        axis.set_ylim(1e-9, 2.)
        axis.set_xlim(.8 * min(seconds), 1.2 * max(seconds))
        axis.legend(fontsize="small", loc="lower left")
    figure.suptitle("Searches for the least potential energy at fixed volume, 9 heights")
    drawing.save(figure, output, "design-searches.png")
    print_table([{**{key: value for key, value in row.items() if key != "picture"},
                  "objective": f"{row['objective']:.8f}"} for row in table])


def write_paper(output, quick):
    """A table only: per problem and method, on one rank and on two, beside the paper."""
    rows = design.measure_paper(quick)
    write_csv(output / "design-paper.csv", rows)
    table = []
    for variables, (state, serial, parallel) in design.PAPER.items():
        table.append({"variables": variables, "method": "the paper", "state": state,
                      "derivatives": serial, "in states": serial / state,
                      "state, parallel": "", "derivatives, parallel": parallel,
                      "speed-up": serial / parallel})
        found = {(row["method"], row["ranks"]): row for row in rows
                 if row["variables"] == variables}
        for one, two in ((found[name, 1], found[name, 2]) for name, ranks in found
                         if ranks == 1):
            table.append({
                "variables": variables, "method": one["method"], "state": one["state"],
                "derivatives": one["gradient"], "in states": one["gradient"] / one["state"],
                "state, parallel": two["state"], "derivatives, parallel": two["gradient"],
                "speed-up": one["gradient"] / two["gradient"]})
    print_table(table)


CHARTS = {"variables": draw_variables, "searches": draw_searches, "paper": write_paper}
