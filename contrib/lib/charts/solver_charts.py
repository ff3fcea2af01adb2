"""The chart of solvers: the file and picture of what solvers.py measures."""

import drawing  # first: it chooses pictures without a display
import matplotlib.pyplot as plt

import solvers
from gradient_charts import by, curves, legend_below
from runs import print_table, write_csv


def draw(output, quick):
    rows = solvers.measure(quick)
    write_csv(output / "solvers.csv", rows)
    charts = by(rows, "chart")
    print_table([{"chart": chart, "solver": solver,
                  **{key: " / ".join(f"{row[key]:g}" for row in group)
                     for key in ("x", "F-mults")}}
                 for chart, of_chart in charts.items()
                 for solver, group in by(of_chart, "solver").items()])
    shown = [(chart, "F-mults") for chart in charts] + [("subdomains", "seconds")]
    figure, axes = plt.subplots(2, 4, figsize=(17., 8.), layout="constrained")
    order = sorted({row["solver"] for row in rows})
    for axis, (chart, y) in zip(axes.flat, shown):
        curves(axis, charts[chart], "solver", "x", y, order)
        axis.set_xlabel(chart)
        axis.set_ylabel(y)
    legend_below(figure, axes, 5, .07)
    drawing.save(figure, output, "solvers.png")


CHARTS = {"solvers": draw}
