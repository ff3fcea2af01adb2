"""Read profile.step by the program gmsh and as text, and evaluate patches of cylinders without Snug."""

import csv
import math
import pathlib
import re
import subprocess
import tempfile


def step_nodes(path, size):
    """Return the nodes of Gmsh's mesh of the faces of a STEP file, in mm. The nodes lie on the surfaces
    as OpenCASCADE has read them; elements have at most the size @p size, in mm."""
    with tempfile.TemporaryDirectory() as folder:
        script, mesh = pathlib.Path(folder, "faces.geo"), pathlib.Path(folder, "faces.msh")
        script.write_text('SetFactory("OpenCASCADE");\n'
                          f'faces() = ShapeFromFile("{pathlib.Path(path).resolve()}");\n'
                          f"Mesh.CharacteristicLengthMax = {size};\n", encoding="utf-8")
        subprocess.run(["gmsh", "-2", "-nopopup", "-v", "1", "-format", "msh2", script, "-o", mesh],
                       check=True, capture_output=True, timeout=120)
        lines = mesh.read_text(encoding="utf-8").splitlines()
    first = lines.index("$Nodes") + 2
    return [tuple(map(float, line.split()[1:]))
            for line in lines[first:first + int(lines[first - 1])]]


def step_volume(path):
    """Return the volume of the only solid of a STEP file, as Gmsh computes it, in mm^3."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder, "solid.geo")
        script.write_text('SetFactory("OpenCASCADE");\n'
                          f'v() = ShapeFromFile("{pathlib.Path(path).resolve()}");\n'
                          'm = Mass Volume{v(0)};\nPrintf("volume %.15g of %g", m, #v());\n',
                          encoding="utf-8")
        done = subprocess.run(["gmsh", "-0", "-nopopup", script, "-o", pathlib.Path(folder, "solid.brep")],
                              check=True, capture_output=True, text=True, timeout=120)
    volume, n = re.search(r"volume (\S+) of (\d+)", done.stdout + done.stderr).groups()
    if int(n) != 1:
        raise ValueError(f"{path} has {n} shapes")
    return float(volume)


def step_text(path):
    """Return the text of a STEP file without blanks and ends of lines."""
    return "".join(pathlib.Path(path).read_text(encoding="utf-8").split())


def face_names(path):
    """Return the names of the faces of a STEP file."""
    return [part.split("'")[1] for part in step_text(path).split("ADVANCED_FACE(")[1:]]


def step_points(path):
    """Return the points in the text of a STEP file, in the unit of the file."""
    return [tuple(map(float, numbers.split(","))) for numbers in
            re.findall(r"CARTESIAN_POINT\('',\(([^,)]+,[^,)]+,[^,)]+)\)\)", step_text(path))]


def step_unit(path):
    """Return the unit of length that the text of a STEP file names, in mm."""
    text = step_text(path)

    def size(number):
        unit = re.search(rf";#{number}=([^;]*)", text)[1]
        found = re.search(r"CONVERSION_BASED_UNIT\('\w+',#(\d+)\)", unit)
        if found:
            factor, base = re.search(
                rf";#{found[1]}=LENGTH_MEASURE_WITH_UNIT\(([^,]*),#(\d+)\)", text).groups()
            return float(factor) * size(base)
        prefix = re.fullmatch(r"\(LENGTH_UNIT\(\)NAMED_UNIT\(\*\)SI_UNIT\((.*),\.METRE\.\)\)", unit)[1]
        return {"$": 1e3, ".KILO.": 1e6, ".CENTI.": 10., ".MILLI.": 1., ".MICRO.": 1e-3}[prefix]

    return size(re.search(r"GLOBAL_UNIT_ASSIGNED_CONTEXT\(\(#(\d+),", text)[1])


def spline(points, degree, s):
    """Return the value at s of clamped B-splines with uniform knots, by de Boor's algorithm."""
    spans = len(points) - degree
    knots = [0.] * degree + [k / spans for k in range(spans + 1)] + [1.] * degree
    k = min(int(s * spans), spans - 1) + degree
    values = points[k - degree:k + 1]
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            left, right = knots[j + k - degree], knots[j + 1 + k - r]
            part = (s - left) / (right - left)
            values[j] = (1 - part) * values[j - 1] + part * values[j]
    return values[degree]


class Crown:
    """The crown of a cylinder about the axis (0, z_axis) along x: heights over 0 <= x <= length,
    even in x, of the control points in control-points.csv."""

    def __init__(self, directory, radius, z_axis, length, degree=3):
        self.radius, self.z_axis, self.length, self.degree = radius, z_axis, length, degree
        with open(pathlib.Path(directory, "control-points.csv"), newline="",
                  encoding="utf-8") as file:
            rows = [{name: float(row[name]) for name in
                     ("dy", "dz", "y", "z")} for row in csv.DictReader(file)]
        heights = []
        for row in rows:
            y, z = row["y"] - row["dy"], row["z"] - row["dz"] - z_axis
            heights.append((row["dy"] * y + row["dz"] * z) / math.hypot(y, z))
        self.points = heights[:0:-1] + heights

    def height(self, x):
        return spline(self.points, self.degree, (1 + x / self.length) / 2)

    def drop(self, x):
        return self.height(0) - self.height(x)

    def deviation(self, nodes):
        """Return the maximum distance of nodes from the crowned cylinder along its radius."""
        return max(abs(math.hypot(y, z - self.z_axis) - self.radius - self.height(x))
                   for x, y, z in nodes)
