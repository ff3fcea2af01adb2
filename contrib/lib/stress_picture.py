"""Draw the von Mises stress on a cut through the bodies, whole and at the contact."""

from matplotlib.collections import LineCollection
import numpy as np

from drawing import (Panel, compose, frame, mark, number_text, outline_window, paint, place_text,
                     proportions, scales, stretched_by, titles)
from obstacles import draw_obstacles, widened
from sections import bounds_of, halves, section
from unrolled import bore_of
from views import AXES, along_axis, oblique


class Drawn:
    """This class has what is drawn of one state: the section, the windows of the contact, and the
    obstacles."""

    def __init__(self, state, side, plane, obstacles):
        axis, self.place, self.plane = plane
        self.state, self.axis, self.obstacles = state, axis, obstacles
        self.faces = section(state, self.plane)
        self.view = along_axis(2 if axis is None else axis)
        self.coordinates = [k for k in range(3) if k != (2 if axis is None else axis)]
        self.peak = self.faces.values.max(initial=0.)
        self.highest = self.faces.points[np.argmax(self.faces.values)]
        low, high = self.faces.points.min(axis=0), self.faces.points.max(axis=0)
        self.whole = widened(obstacles, low[self.coordinates], high[self.coordinates],
                             self.coordinates, self.place or 0.)
        self.windows = side.window().levels(self.coordinates, *self.whole) if side else []

    def add_obstacles(self, axis, view, level):
        draw_obstacles(axis, self.obstacles, view, *[self.whole, *self.windows][level],
                       self.coordinates, self.place or 0.)

    def mark(self, axis, view, level):
        """Mark the peak and the window of the next level, if there is one."""
        mark(axis, view.project(self.highest))
        if level < len(self.windows):
            outline_window(axis, view, self.windows[level], self.coordinates, self.place or 0.)


def cut_axis(side):
    """Return the axis across the cut: of those along the contact, that along which the contact is
    shortest, so that the cut shows its length; y if there is no difference."""
    if side is None:
        return 1
    bore = bore_of([side])
    if bore:
        return bore.axis  # the cut shows the whole circle
    normal, size = side.normal(), side.window().size
    first, second = (1, 0) if normal == 2 else (2, 0) if normal == 1 else (1, 2)
    return second if size[second] < 0.8 * size[first] else first


def place_of_cut(state, side, axis):
    """Return the place of the largest pressure; of several, that next to the middle."""
    low, high = bounds_of(state)
    middle = (low[axis] + high[axis]) / 2.
    if side is None:
        return middle
    places = side.peaks()[:, axis]
    # of places at both sides of the middle, the first one
    distances = np.round(np.abs(places - middle) / (high - low)[axis], 6)
    extent = (high - low)[axis]
    place = np.round(places[np.argmin(distances)] / extent, 9) * extent  # no zero with round-off
    return float(np.clip(place, low[axis], high[axis])) + 0.


def draw_section(axis, drawn, level, ends, units, stretched):
    """Draw the whole section, level 0, or one of its windows."""
    faces = drawn.faces
    drawn.add_obstacles(axis, drawn.view, level)
    image = paint(axis, drawn.view, faces.points, faces.polygons, faces.values, ends)
    axis.add_collection(LineCollection(drawn.view.project(faces.lines), colors="black",
                                       linewidths=.7))
    drawn.mark(axis, drawn.view, level)
    frame(axis, drawn.view, *[drawn.whole, *drawn.windows][level], units, stretched)
    return image


def draw_half(axis, drawn, view, side, ends, units):
    image = None
    bodies = halves(drawn.state, drawn.plane, drawn.axis, side, view)
    for layer, faces in enumerate(bodies):
        image = paint(axis, view, faces.points, faces.polygons, faces.values, ends)
        image.set_zorder(1 + layer)
        axis.add_collection(LineCollection(view.project(faces.lines), colors="black",
                                           linewidths=.6, zorder=1.5 + layer))
    places = view.project(np.concatenate([faces.points for faces in bodies]))
    if drawn.obstacles:
        drawn.add_obstacles(axis, view, 0)
        corners = np.full((2, 3), drawn.place)
        corners[:, drawn.coordinates] = drawn.whole
        places = np.concatenate([places, view.project(corners)])
    frame(axis, view, places.min(axis=0), places.max(axis=0), units)
    drawn.mark(axis, view, 0)
    return image


def half_panel(drawn, title, ends, units, chosen):
    """Return the panel of the bodies in space on one side of the cut."""
    low, high = bounds_of(drawn.state)
    axis, middle = drawn.axis, (low + high)[drawn.axis] / 2.
    side = -1. if axis == 1 else 1.
    if (drawn.place - middle) * side < -1e-3 * (high - low)[axis]:
        side = -side  # the viewer would look at the smaller part
    view = chosen or oblique(axis, side)
    if chosen and abs(view.towards[axis]) > 1e-9:
        side = np.sign(view.towards[axis])
    corners = view.project(np.array([[(low, high)[(k >> d) & 1][d] for d in range(3)]
                                     for k in range(8)]))
    ratio = np.clip(np.divide(*np.ptp(corners, axis=0)), 0.3, 4.)
    return Panel(ratio, f"{title}\ncut at {AXES[axis]} = {drawn.place:.4g}",
                 lambda panel: draw_half(panel, drawn, view, side, ends, units))


def section_panel(drawn, level, title, ends, units, scale):
    ratio, stretch = proportions(*[drawn.whole, *drawn.windows][level], 4. if level else 10.)
    title += stretched_by(drawn.view.names, stretch)
    return Panel(ratio, title, lambda panel: draw_section(
        panel, drawn, level, ends, units, stretch != 1.), scale)


def group_of(drawn, title, end, units, chosen):
    """Return the panels of one state: the whole, and the section or its parts at the contact."""
    ends, names = (0., end), [AXES[k] for k in drawn.coordinates]
    extent = np.max(drawn.whole[1] - drawn.whole[0])
    peak = f"× maximum {number_text(drawn.peak)} at " + place_text(
        names, drawn.highest[drawn.coordinates], extent)
    title = f"{title}\n{peak}".strip()
    if drawn.axis is None:
        panels = [section_panel(drawn, 0, title, ends, units, "")]
    else:
        panels = [half_panel(drawn, title, ends, units, chosen)]
        if not drawn.windows:
            panels.append(section_panel(drawn, 0, "section", ends, units, ""))
    for level in range(1, len(drawn.windows) + 1):
        head = "at the contact" if level == len(drawn.windows) else "around the contact"
        panels.append(section_panel(drawn, level, head, ends, units, ""))
    panels[-1] = panels[-1]._replace(scale=units.label("von Mises stress", units.stress))
    return panels


def draw_von_mises(run, states, sides, planes):
    """Draw von-mises.png. sides: of each state the slave side with the largest pressure, or None;
    planes: (axis, place, vtkPlane) of the cuts of the states, None for flat bodies."""
    drawn = [Drawn(state, side, plane, run.obstacles) for state, side, plane in
             zip(states, sides, planes or [(None, None, None)] * len(states))]
    ends = scales([of_state.peak for of_state in drawn])
    groups = [group_of(of_state, title, end, run.units, run.options.view)
              for of_state, title, end in zip(drawn, titles(states), ends)]
    compose(f"{run.title}: von Mises stress on the deformed bodies", groups, run.directory,
            "von-mises.png")
