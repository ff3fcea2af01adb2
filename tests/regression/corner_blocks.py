"""A block in a corner, which touches two walls."""

import pathlib
import tempfile

from cut_blocks import Block, run

CORNER = """
set Task = state
set Dimension = {dim}
set Element degree = {degree}
set Bodies = block{bodies}
set Obstacles = {obstacles}
subsection Body block
  set Mesh = file
  set File = block.inp
  set Young's modulus = 10000
  set Supports = {rollers}
  set Pressure = top: 100, right: 50
end
{more}
subsection Contact
  set Pairs = {pairs}
  set Method = {method}
end
subsection Solver
  set Relative tolerance = 1e-11
end
"""


def check_corner(snug, dim, degree, method, master, ranks):
    """A block in a corner, pressed by 100 from above and by 50 from its side: the nodes on the
    edge of both faces have a row for each wall, with the area on its own faces."""
    rollers = "front: y" if dim == 3 else ""
    block = Block([0.] * dim, [1.] * dim, [4, *[3] * (dim - 2), 4])
    ell = Block([-0.5, *[0.] * (dim - 2), -0.5], [1.] * dim, [6, *[3] * (dim - 2), 6],
                keep=lambda x: x[0] < 0. or x[-1] < 0.)
    runs = []
    pairs = {"obstacle": ["block.bottom: floor, block.left: wall",
                          "block.left: wall, block.bottom: floor"],
             "body": ["block.bottom: ell.floor, block.left: ell.wall",
                      "block.left + block.bottom: ell.wall + ell.floor"]}[master]
    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory)
        (folder / "block.inp").write_text(block.text(lambda side, x: side)[0])
        (folder / "ell.inp").write_text(ell.text(
            lambda side, x: "floor" if side == "top" and abs(x[-1]) < 1e-9
            else "wall" if side == "right" and abs(x[0]) < 1e-9 else side)[0])
        more = {"body": f"""
subsection Body ell
  set Mesh = file
  set File = ell.inp
  set Young's modulus = 10000
  set Supports = bottom: {"xyz"[:dim]}{", " + rollers if rollers else ""}
end
""", "obstacle": f"""
subsection Obstacle floor
end
subsection Obstacle wall
  set Normal = {"1, 0" if dim == 2 else "1, 0, 0"}
end
"""}[master]
        for of in pairs:
            runs.append(run(snug, directory, CORNER.format(
                dim=dim, degree=degree, method=method, rollers=rollers, pairs=of, more=more,
                bodies=", ell" if master == "body" else "",
                obstacles="floor, wall" if master == "obstacle" else ""), ranks))
    errors = []
    for summary, rows in runs:
        force = summary["state"]["contact_force"]
        for d, wanted in ((0, 50.), (dim - 1, 100.)):
            if abs(abs(force[d]) - wanted) > 1e-7:
                errors.append(f"force {force}")
        if master == "obstacle":
            errors += [f"pressure {row['pressure']} at {row['x']}" for row in rows
                       if min(abs(row["pressure"] - p) for p in (50., 100.)) > 1e-6]
    key = {"floor": 100., "wall": 50.}
    for name, wanted in key.items():
        for pair in runs[0][0]["state"]["pairs"]:
            if name in pair["name"] and abs(max(map(abs, pair["force"])) - wanted) > 1e-7:
                errors.append(f"force of {pair['name']}: {pair['force']}")
    # Rows that a list adds, of a face along a wall, carry nothing.
    pressures = [sorted(row["pressure"] for row in rows if row["pressure"] > 1e-6)
                 for summary, rows in runs]
    if len(pressures[0]) != len(pressures[1]) or any(
            abs(a - b) > 1e-6 * max(pressures[0]) for a, b in zip(*pressures)):
        errors.append(f"pressures {pressures[0][:3]} and {pressures[1][:3]}")
    return errors
