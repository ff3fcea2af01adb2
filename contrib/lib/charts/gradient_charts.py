"""The charts of gradients: files and pictures of what the other modules measure."""

import drawing  # first: it chooses pictures without a display
import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator

import slender
import steps
import tolerances
import weak
from runs import print_table, write_csv

# Below this an error is rounding; logarithmic axes have no zero.
FLOOR = 1e-16

MARKERS = "osD^v<>Px*"


def by(rows, key):
    """{value of key: its rows}, in the order of the rows."""
    groups = {}
    for row in rows:
        groups.setdefault(row[key], []).append(row)
    return groups


def curves(axis, rows, key, x, y, order=None):
    """One logarithmic curve per value of key that has any y; colours by its place among all,
    or in the order."""
    groups = by(rows, key)
    for name, group in groups.items():
        index = (order or list(groups)).index(name)
        if any(row[y] > 0. for row in group):
            axis.loglog([row[x] for row in group],
                        [max(row[y], FLOOR) for row in group],
                        MARKERS[index] + "-", color=f"C{index}", label=name,
                        markersize=4, linewidth=1.)
    axis.set_xlabel(x)
    axis.grid(True, alpha=0.3)


def panels(columns, height=4.5):
    return plt.subplots(1, columns, figsize=(5. * columns + 2.5, height),
                        layout="constrained", squeeze=False)


def add_legend(axis, *entries):
    """Right of the axis, of its own curves or of others: handles, labels."""
    axis.legend(*entries, loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize="small")


def legend_below(figure, axes, columns, height):
    """Of all curves of some axes together; height: part of the figure."""
    labels = {label: handle for axis in axes.flat
              for handle, label in zip(*axis.get_legend_handles_labels())}
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))
    figure.legend(labels.values(), labels.keys(), loc="lower center", ncols=columns,
                  fontsize="small")


def draw_steps(output, quick):
    rows = steps.measure(quick)
    write_csv(output / "gradient-steps.csv", rows)
    print_table(rows)
    scenes = by(rows, "scene")
    figure, axes = plt.subplots(len(scenes), 2, squeeze=False, sharex=True,
                                sharey=True, layout="constrained",
                                figsize=(13., 3.6 * len(scenes) + 0.6))
    for line, (scene, group) in zip(axes, scenes.items()):
        for axis, quantity in zip(line, ("error of dJ", "error of u'")):
            curves(axis, group, "method", "step", quantity)
            axis.set_title(f"{scene}: {quantity}", fontsize="medium")
        line[0].set_ylabel("relative error")
    figure.suptitle("Error against step: of cell size (semi-analytic), "
                    "of bound width (overall)")
    axes[0, 1].legend(*axes[0, 0].get_legend_handles_labels(),
                      loc="center left", bbox_to_anchor=(1.02, 0.5),
                      fontsize="small")
    drawing.save(figure, output, "gradient-steps.png")


def draw_slender(output, quick):
    rows = slender.measure(quick)
    write_csv(output / "gradient-slender.csv", rows)
    print_table(rows)
    figure, ((axis,),) = panels(1, 5.)
    for row in rows:
        row["label"] = row["derivatives"] + (
            "" if row["derivatives"] == "exact" else f", step {row['step']:g}")
    curves(axis, rows, "label", "L/H", "error")
    forward = by(rows, "derivatives")["forward"]
    places = [row["L/H"] for row in forward]
    axis.loglog(places, [0.5 * forward[0]["error"] * (place / places[0])**2
                         for place in places], "k:", label="(L/H)²")
    axis.set_ylabel("relative error of dC/dL")
    axis.set_title("Cantilever, length as variable")
    axis.set_xticks(places, [str(place) for place in places])
    axis.minorticks_off()
    add_legend(axis)
    drawing.save(figure, output, "gradient-slender.png")


def draw_tolerances(output, quick):
    rows = tolerances.measure(quick)
    write_csv(output / "gradient-tolerances.csv", rows)
    print_table(rows)
    figure, ((axis,),) = panels(1, 5.)
    curves(axis, rows, "method", "tolerance", "error of dJ")
    axis.set_xlabel("tolerance of the state")
    axis.set_ylabel("relative error of dJ")
    axis.set_title("3D Hertz, 9 heights; steps of overall differences 1e-4")
    add_legend(axis)
    drawing.save(figure, output, "gradient-tolerances.png")


def draw_weak(output, quick):
    sides, path, widest = weak.measure(quick)
    write_csv(output / "gradient-weak.csv", sides)
    print_table([{key: f"{value:.6f}" if isinstance(value, float) else value
                  for key, value in row.items()} for row in sides])
    write_csv(output / "gradient-weak-path.csv", path)
    figure, axes = panels(2)
    compliance, energy = axes[0]
    for axis, name in ((compliance, "compliance"), (energy, "energy")):
        below = [row for row in path if row["load"] < 0.]
        above = [row for row in path if row["load"] > 0.]
        label = "gradient of a state"
        for part in (below, above) if axis is compliance else (path,):
            axis.plot([row["load"] for row in part],
                      [row[name] for row in part], "C0.-", markersize=4,
                      label=label)
            label = None
        axis.set_xlabel("load over that of the weak contact, less 1")
        axis.xaxis.set_major_locator(MaxNLocator(5))
        axis.grid(True, alpha=0.3)
    for name, style in (("QP, up", "C1^"), ("QP, down", "C1v"),
                        ("strong set", "C2+"), ("central differences", "C3x")):
        compliance.plot(0., widest[name], style, markersize=8, label=name,
                        fillstyle="none")
    compliance.set_title("compliance, by the adjoint method")
    energy.set_title("potential energy")
    compliance.set_ylabel(f"derivative by height {widest['variable']}")
    compliance.legend(fontsize="small")
    figure.suptitle("Across a weakly active contact")
    drawing.save(figure, output, "gradient-weak.png")


CHARTS = {"steps": draw_steps, "slender": draw_slender, "tolerances": draw_tolerances,
          "weak": draw_weak}
