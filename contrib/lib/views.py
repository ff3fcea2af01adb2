"""From where pictures look at bodies in space, and where they cut them."""

import math
import re

import numpy as np

from states import PlotError

AXES = "xyz"


class View:
    """This class projects points on the plane across a direction: coordinates in it are first
    to the right, then upwards."""

    def __init__(self, towards, right, up, names=None, flipped=False):
        self.towards = np.array(towards, dtype=float)  # from the bodies to the viewer
        self.right, self.up = np.array(right, dtype=float), np.array(up, dtype=float)
        self.names = names      # of the coordinates in the plane; None: they are no axes
        self.flipped = flipped  # the first coordinate grows to the left

    def project(self, points):
        return points @ np.transpose([self.right, self.up])

    def depth(self, points):
        """Return the distances towards the viewer."""
        return points @ self.towards


def along_axis(axis, sign=None):
    """Return the view along an axis, 0 to 2, with the other axes in their order to the right and
    upwards. The sign of the side from which it looks: None for that where no axis is flipped."""
    across, up = (k for k in range(3) if k != axis)
    natural = -1. if axis == 1 else 1.
    unit = np.eye(3)
    sign = natural if sign is None else sign
    return View(sign * unit[axis], unit[across], unit[up], AXES[across] + AXES[up],
                sign != natural)


def from_angles(azimuth, elevation):
    """Return the view from an azimuth in the plane of x and y, from x, and an elevation above it
    [degrees]."""
    a, e = math.radians(azimuth), math.radians(elevation)
    towards = np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
    right = np.array([-math.sin(a), math.cos(a), 0.])
    return View(towards, right, np.cross(towards, right))


def oblique(cut_axis, sign):
    """Return the view of a body in space that shows its cut across an axis, from the side given by
    the sign, and its upper side."""
    azimuth = {0: 90. - 90. * sign + 30., 1: 90. * sign + 30., 2: -60.}[cut_axis]
    return from_angles(azimuth, 25. if cut_axis < 2 else 50. * sign)


def read_view(text):
    """Return the view of an axis, '-y', or of two angles, '-60,25'."""
    axis = re.fullmatch(r"([+-]?)([xyz])", text.strip())
    if axis:
        return along_axis(AXES.index(axis[2]), -1. if axis[1] == "-" else 1.)
    try:
        azimuth, elevation = (float(word) for word in text.split(","))
        if not (math.isfinite(azimuth) and -90. <= elevation <= 90.):
            raise ValueError
    except ValueError:
        raise PlotError(f"--view is '{text}', but must be an axis (x, -x, y, ..) or AZIMUTH,"
                        "ELEVATION in degrees with an elevation of -90 to 90") from None
    return from_angles(azimuth, elevation)


def read_cut(text):
    """Return the (axis, place) of a cut 'y=0.5'."""
    found = re.fullmatch(r"\s*([xyz])\s*=\s*(\S+)\s*", text)
    try:
        place = float(found[2])
        if not math.isfinite(place):
            raise ValueError
    except (TypeError, ValueError):
        raise PlotError(f"--cut is '{text}', but must be an axis and a coordinate, "
                        "for example y=0.5") from None
    return AXES.index(found[1]), place


class Window:
    """This class is the box of a contact, in space: corners low and high, and the size across
    the normal, the axis closest to it, is at least the width of the contact."""

    def __init__(self, points, normal):
        low, high = points.min(axis=0), points.max(axis=0)
        size = high - low
        tangents = [k for k in range(3) if k != normal and size[k] > 1e-9 * size.max()]
        size[normal] = max(size[normal], min((size[k] for k in tangents), default=0.))
        self.middle, self.size = (low + high) / 2., size

    def levels(self, plane, low, high):
        """Return the windows in the plane of two axes, as (lower, upper) corners within the whole
        from low to high: the surroundings of the contact, and before it one in between if these
        are less than a thirtieth of the whole; none if they are more than 0.16 of it."""
        middle, size = self.middle[plane], self.size[plane]
        size = np.maximum(size, 1e-3 * size.max())
        extent = np.maximum(high - low, 1e-9 * (high - low).max())

        def of_size(half):
            return np.maximum(low, middle - half), np.minimum(high, middle + half)
        first, last = of_size(size)
        if size.max() == 0. or np.prod((last - first) / extent) > 0.16 or np.any(last <= first):
            return []
        ratio = np.max(extent) / np.max(last - first)
        between = [of_size(np.full(2, size.max()) * np.sqrt(ratio))] if ratio > 30. else []
        return [*between, (first, last)]
