"""Bores and shafts: round faces about an axis, unrolled over the angle."""

import numpy as np

from views import AXES, View

# A face is unrolled if it deviates from a circle by no more than this share of its radius, and if
# it goes around by one angle, or its loaded part by the other one [degrees].
ROUND, AROUND, LOADED = .03, 150., 45.


def wrapped(angles):
    """Return angles between -180 and 180 degrees."""
    return (np.asarray(angles) + 180.) % 360. - 180.


def widest_gap(angles):
    """Return the size and the middle of the largest gap between angles on the circle."""
    ordered = np.sort(wrapped(angles))
    gaps = np.diff(ordered, append=ordered[0] + 360.)
    widest = int(np.argmax(gaps))
    return gaps[widest], ordered[widest] + gaps[widest] / 2.


class Bore:
    """This class is a circle about an axis, 0 to 2, with its centre and radius. Angles are those
    from the next axis to the one after it, within half a turn of the middle."""

    def __init__(self, axis, centre, radius):
        self.axis, self.centre, self.radius, self.middle = axis, centre, radius, 180.
        self.across = [(axis + 1) % 3, (axis + 2) % 3]
        self.name = f"angle from {AXES[self.across[0]]}"

    def angles(self, points, near=None):
        """Return the angles [degrees] of points (.., 3), within half a turn of others if given."""
        first, second = np.moveaxis(points[..., self.across] - self.centre, -1, 0)
        near = self.middle if near is None else near
        return near + wrapped(np.degrees(np.arctan2(second, first)) - near)

    def of_faces(self, points):
        """Return the angles of the corners of faces (n, corners, 3): no face is torn."""
        return self.angles(points, self.angles(points.mean(axis=1))[:, None])

    def extent(self, points):
        return 360. - widest_gap(self.angles(points))[0] if len(points) else 0.

    def place(self, points, pressures):
        """Put the middle where the faces are, or, if they go all around, opposite to where there
        is least pressure."""
        angles = np.radians(self.angles(points))
        gap, opposite = widest_gap(np.degrees(angles))
        mean = (pressures * np.exp(1j * angles)).sum()
        if gap > 30.:
            self.middle = float(wrapped(opposite + 180.))
        elif abs(mean) > .1 * pressures.sum():
            self.middle = 90. * round(np.degrees(np.angle(mean)) / 90.)

    def view(self):
        """Return the view of points (angle, place along the axis, 0), seen to scale if the angle is
        times arc()."""
        axes = np.eye(3)
        return View(axes[2], axes[0], axes[1], (self.name, AXES[self.axis]))

    def arc(self):
        """Return the length of the arc of one degree."""
        return self.radius * np.pi / 180.


def fitted(points, normals=None):
    """Return the Bore of points (n, 3) with these normals of faces, of flat bodies without; None:
    the face is not round."""
    axis = 2
    if normals is not None:
        share = np.square(normals).sum(axis=0)
        axis = int(np.argmin(share))
        if share[axis] > 1e-3 * share.sum():
            return None
    bore = Bore(axis, np.zeros(2), 1.)
    flat = points[:, bore.across]
    matrix = np.column_stack([2. * flat, np.ones(len(flat))])
    centre = np.linalg.lstsq(matrix, np.square(flat).sum(axis=1), rcond=None)[0][:2]
    radii = np.linalg.norm(flat - centre, axis=1)
    bore.centre, bore.radius = centre, radii.mean()
    return bore if np.ptp(radii) / 2. <= ROUND * bore.radius else None


def bore_of(row):
    """Return the Bore that the Sides of some states surround, or None."""
    side = row[0]
    bore = fitted(side.points[side.nodes], None if side.flat else side.normals())
    if bore is None:
        return None
    pressure = np.max([of_state.pressure[of_state.nodes] for of_state in row], axis=0) \
        if len({len(of_state.nodes) for of_state in row}) == 1 else side.pressure[side.nodes]
    points = side.points[side.nodes]
    if bore.extent(points) < AROUND and bore.extent(points[pressure > 0.]) < LOADED:
        return None
    bore.place(points, pressure)
    return bore
