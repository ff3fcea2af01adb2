#!/usr/bin/python3
"""VTK reads the states that a run leaves, and contrib/plot draws them: pictures.py SNUG SCENE.

The scene is optimized on two ranks with a file each, and every design is drawn. What VTK reads is
checked against the history, the summary and itself."""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPUnstructuredGridReader
except ImportError:  # the packages are those of Debian's Python
    if os.path.realpath(sys.executable) == os.path.realpath("/usr/bin/python3"):
        raise
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

ROOT = pathlib.Path(__file__).resolve().parents[2]
FACES = "left", "right", "front", "back", "bottom", "top"


def arrays(grid):
    """Return the arrays at the points, and the names of their components."""
    data = grid.GetPointData()
    of_points = [data.GetArray(k) for k in range(data.GetNumberOfArrays())]
    return ({array.GetName(): vtk_to_numpy(array).astype(float) for array in of_points},
            {array.GetName(): [array.GetComponentName(c)
                               for c in range(array.GetNumberOfComponents())]
             for array in of_points})


def series(path):
    """Return {time: {group: {name: grids}}} of a .pvd file."""
    return {float(entry.get("timestep")): blocks(path.parent / entry.get("file"))
            for entry in xml.etree.ElementTree.parse(path).iter("DataSet")}


def named(block):
    return {block.GetMetaData(k).Get(block.NAME()): block.GetBlock(k)
            for k in range(block.GetNumberOfBlocks())}


def sizes(grid, kind):
    """Return the sum of the areas or volumes of the cells, which is signed."""
    size = vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    return vtk_to_numpy(size.GetOutput().GetCellData().GetArray(kind)).sum()


def blocks(path):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return {group: {name: [grid] if grid.IsA("vtkDataSet") else list(named(grid).values())
                    for name, grid in named(block).items()}
            for group, block in named(reader.GetOutput()).items()}


class States(unittest.TestCase):
    def test_times_are_iterations(self):
        with open(OUTPUT / "history.csv", newline="", encoding="utf-8") as file:
            iterations = [float(row["iteration"]) for row in csv.DictReader(file)]
        for name in ("solution", "contact"):
            self.assertEqual(sorted(series(OUTPUT / f"{name}.pvd")), iterations)

    def test_bodies_and_boundaries_have_their_names(self):
        found = list(series(OUTPUT / "solution.pvd").values())[-1]
        self.assertEqual(list(found["bodies"]), ["upper", "lower"])
        self.assertEqual(list(found["boundaries"]), [f"{body}.{face}" for body in
                                                     ("upper", "lower") for face in FACES])
        cells = {name: sum(piece.GetNumberOfCells() for piece in pieces)
                 for group in found.values() for name, pieces in group.items()}
        self.assertEqual((cells["upper"], cells["lower"]), (48, 48))
        self.assertEqual([cells[f"upper.{face}"] for face in FACES], [12, 12, 12, 12, 16, 16])
        left = np.concatenate([vtk_to_numpy(piece.GetPoints().GetData())
                               for piece in found["boundaries"]["lower.left"]])
        self.assertTrue(np.all(np.abs(left[:, 0]) < 1e-6))
        self.assertEqual(list(list(series(OUTPUT / "contact.pvd").values())[-1]["boundaries"]),
                         ["upper.bottom", "lower.top"])

    def test_stresses_agree(self):
        found = list(series(OUTPUT / "solution.pvd").values())[-1]
        for pieces in (*found["bodies"].values(), *found["boundaries"].values()):
            for piece in pieces:
                values, names = arrays(piece)
                self.assertEqual(names["stress"], ["XX", "YY", "ZZ", "XY", "YZ", "XZ"])
                self.assertEqual(names["principal_stress"], ["maximum", "middle", "minimum"])
                self.assertEqual(names["displacement"], ["X", "Y", "Z"])
                xx, yy, zz, xy, yz, xz = values["stress"].T
                tensors = np.moveaxis(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), 2, 0)
                principal = np.linalg.eigvalsh(tensors)[:, ::-1]
                size = np.abs(principal).max()
                # single precision of the file
                self.assertLess(np.abs(principal - values["principal_stress"]).max(), 1e-5 * size)
                a, b, c = values["principal_stress"].T
                mises = np.sqrt(((a - b)**2 + (b - c)**2 + (c - a)**2) / 2.)
                self.assertLess(np.abs(mises - values["von_mises"]).max(), 1e-5 * size)

    def test_the_joined_file_has_the_bodies(self):
        reader = vtkXMLPUnstructuredGridReader()
        reader.SetFileName(str(OUTPUT / "solution-0000.pvtu"))
        reader.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfCells(), 96)
        values, names = arrays(reader.GetOutput())
        self.assertEqual(names["stress"][3], "XY")
        self.assertEqual(set(values["body"]), {0., 1.})

    def test_forces_add_up(self):
        summary = json.loads((OUTPUT / "summary.json").read_text(encoding="utf-8"))
        found = list(series(OUTPUT / "contact.pvd").values())[-1]["boundaries"]["upper.bottom"]
        total = sum(arrays(piece)[0]["force"].sum() for piece in found)
        along = abs(summary["state"]["contact_force"][2])
        # the curved face is inclined by less than 0.1
        self.assertLess(abs(total / along - 1.), .01)


class Tetrahedra(unittest.TestCase):
    def test_they_are_quadratic_fill_the_bodies_and_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, str(ROOT / "tests/regression/quadratic-elements.prm"),
                            "--output", folder, "--set", "Task=state"], check=True,
                           stdout=subprocess.DEVNULL)
            found = blocks(pathlib.Path(folder, "solution-0000.vtm"))
            for options in ([], ["--cut", "x=0.3"], ["--model"]):
                done = Pictures.plot(*options, directory=folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
        upper, lower = (found["bodies"][body][0] for body in ("upper", "lower"))
        bottom = found["boundaries"]["upper.bottom"][0]
        # The elements at the left of the lower body are refined, so that hexahedra fill them.
        for grid, types in ((upper, {24}), (lower, {12, 24}), (bottom, {22})):
            self.assertEqual({grid.GetCellType(k) for k in range(grid.GetNumberOfCells())}, types)
        self.assertAlmostEqual(sizes(upper, "Volume"), 2., places=5)
        self.assertAlmostEqual(sizes(bottom, "Area"), 2., places=5)


class Pictures(unittest.TestCase):
    @staticmethod
    def plot(*options, directory=None):
        return subprocess.run([str(ROOT / "contrib/plot"), *options, str(directory or OUTPUT)],
                              text=True, capture_output=True, check=False)

    def test_all_are_drawn(self):
        for options in ([], ["--cut", "x=0.3", "--view", "-60,25"]):
            done = self.plot(*options)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            for name in ("convergence", "shape", "contact-pressure", "von-mises"):
                picture = OUTPUT / (name + ".png")
                self.assertGreater(picture.stat().st_size, 5000, picture)
                picture.unlink()

    def test_the_model_is_drawn(self):
        done = self.plot("--model")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        picture = OUTPUT / "model.png"
        self.assertGreater(picture.stat().st_size, 5000)
        picture.unlink()

    def test_the_model_of_a_parameter_file_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            def draw(scene):
                return subprocess.run([str(ROOT / "contrib/plot"), "--model", scene], text=True,
                                      capture_output=True, check=False, cwd=folder,
                                      env={**os.environ, "SNUG": PROGRAM})
            done = draw(SCENE)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            output = pathlib.Path(folder, "output", pathlib.Path(SCENE).stem)
            self.assertGreater((output / "model.png").stat().st_size, 5000)
            # the meshes are those of the run
            cells = [sum(piece.GetNumberOfCells() for piece in pieces)
                     for pieces in series(output / "model/solution.pvd")[0.]["bodies"].values()]
            self.assertEqual(cells, [48, 48])
            done = draw("nowhere.prm")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)

    def test_a_cut_beside_the_bodies_is_refused(self):
        done = self.plot("--cut", "z=9")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("from z = ", done.stderr)

    def test_damaged_files_are_named(self):
        path = OUTPUT / "solution-0000" / "01-lower.0000.vtu"
        text = path.read_text(encoding="utf-8")
        path.write_text(text[:len(text) // 2], encoding="utf-8")
        try:
            done = self.plot()
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn("01-lower.0000.vtu' is damaged", done.stderr)
        finally:
            path.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--mpiexec", default="mpirun")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        global OUTPUT, PROGRAM, SCENE
        OUTPUT = pathlib.Path(folder)
        PROGRAM, SCENE = map(os.path.abspath, (options.program, options.scene))
        entries = ["Task=optimize", "Optimization/Draw every=1", "Output/Ranks per file=1",
                   "Optimization/Maximum evaluations=4"]
        subprocess.run([options.mpiexec, "-np", "2", options.program, options.scene, "--output",
                        folder, *(word for entry in entries for word in ("--set", entry))],
                       check=False, stdout=subprocess.DEVNULL)
        unittest.main(argv=[sys.argv[0]])


if __name__ == "__main__":
    main()
