"""Simulate the wear of a flat punch by the law of Archard.

A rigid flat punch of half width 1 slides to and fro on a half plane. At the pressure p the distance s
removes the depth w with dw/ds = K p. The variables of the model are the heights of the punch at its
nodes, so that a step of wear is another design. In full contact p = p0 - S w with a constant matrix S,
which is measured once. The implicit step (1 + K ds S) dw = K ds p is then stable for any ds. Answers:

volume  K times force times distance for any distribution of the pressure
shape   surface of a half plane under a uniform pressure (Johnson, Contact mechanics, 1985, section 2.5)
rate    the pressure becomes uniform as exp(-K s / mu) (Goryacheva, Contact mechanics in tribology, 1998):
        mu p(x) = -2 / (pi E*) int ln|x - t| p(t) dt + constant with int p = 0 and the largest mu

The picture is wear.png with the option --picture.
"""

import pathlib
import sys

import numpy as np

import snug

SCENE = pathlib.Path(__file__).resolve().parents[3] / "prm" / "crowned-punch.prm"
LEVELS = 3 if "--quick" in sys.argv else 4
K, E, FORCE = 1e-6, 1000. / .91, 1.  # [1/MPa], E* [MPa], force on half of the punch [N/mm]
x = np.linspace(0., 1., 2 ** (LEVELS + 1) + 1)
SETTINGS = {"Task": "state", "Responses": "size, unevenness", "Response size/Quantity": "volume",
            "Response size/Body": "punch", "Body punch/Local refinements": LEVELS,
            "Body block/Local refinements": LEVELS + 1, "Shape/Basis": "formula modes",
            "Shape/Filter radius": 0, "Shape/Direction": "", "Shape/Bounds": [-.1, .1],
            "Shape/Modes": snug.heights(x, (0, 1))}


def slowest_mode(n=400):
    """Return mu of the even functions on -1 < x < 1 from n constant panels on 0 < x < 1."""
    ends = np.linspace(0., 1., n + 1)
    at = (ends[1:, None] + ends[:-1, None]) / 2.
    primitive = [(z * np.log(np.abs(z)) - z) for z in (ends - at, ends + at)]
    matrix = -2. / (np.pi * E) * sum(np.diff(part) for part in primitive)
    mean_free = np.eye(n) - 1. / n
    return np.linalg.eigvals(mean_free @ matrix @ mean_free).real.max()


with snug.Model(SCENE, SETTINGS) as model:
    def pressure(w):
        return np.asarray(model.evaluate(w, contact=True).contact()["pressure"])

    first, mu, distance = model.evaluate(contact=True), slowest_mode(), 0.
    area, p = (np.asarray(first.contact()[key]) for key in ("area", "pressure"))
    S = np.column_stack([(p - pressure(1e-7 * unit)) / 1e-7 for unit in np.eye(len(x))])
    w, tables = np.zeros(len(x)), {0.: first.contact()}
    for ds in mu / K * np.geomspace(.002, 5., 20):
        w, last = w + np.linalg.solve(np.eye(len(x)) + K * ds * S, K * ds * p), p
        result = model.evaluate(w, contact=True)
        p, distance = np.asarray(result.contact()["pressure"]), distance + ds
        tables[distance] = result.contact()
        # A step divides a mode by 1 + K ds / mu.
        ratio = np.sqrt(area @ (last - FORCE) ** 2 / (area @ (p - FORCE) ** 2))
        print(f"{distance:7.1f} mm: pressures from {p.min():.4f} to {p.max():.4f} MPa")
    requests = model.process.n
volume = (first["size"] - result["size"]) / (K * FORCE * distance)
rest = np.maximum(1. - x, 1e-99)
johnson = ((1. + x) * np.log((1. + x) ** 2) + rest * np.log(rest ** 2)) / (np.pi * E)
shape = np.abs(w - w[0] - johnson).max() / johnson[-1]
rate = K * ds / (ratio - 1.) / mu
print(f"{requests} requests; volume / (K force distance) - 1 = {volume - 1.:.1e}; "
      f"shape - Johnson's = {shape:.2%}; mu / exact = {rate:.4f}")
assert abs(volume - 1.) < 1e-5, "the volume must be that of the law"
assert shape < .02 and np.abs(p - FORCE).max() < .01, "the pressure must become uniform"
assert abs(rate - 1.) < .2 * x[1], "the rate must be that of the slowest mode up to the mesh size"

if "--picture" in sys.argv:
    import snug.plot
    axes = None
    for s in list(tables)[::4]:
        axes = snug.plot.pressure(tables[s], axes, label=f"{s:.0f} mm")
    axes.legend(title="sliding distance")
    axes.set(ylim=(0., 4.), xlabel="x, mm", ylabel="contact pressure, MPa")
    axes.figure.set_size_inches(6., 3.6)
    axes.figure.savefig("wear.png", dpi=120)
