#!/usr/bin/python3
"""The examples of the Python package, each with its own assertions, and its pictures."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from test_snug import HERE, HERTZ, needs, np, snug  # begins again with Debian's Python if need be

EXAMPLES = HERE.parent / "examples"
SCENE = HERE.parents[2] / "prm" / "hertz-3d-9.prm"


@unittest.skipUnless("SNUG" in os.environ, "the variable SNUG is not set")
class Examples(unittest.TestCase):
    def run_example(self, name, *arguments):
        environment = {**os.environ, "PYTHONPATH": str(HERE.parent), "MPLBACKEND": "Agg"}
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", EXAMPLES / name, "--quick", *arguments], cwd=folder,
                           env=environment, check=True)
            for picture in ("--picture" in arguments) * [name.replace(".py", ".png")]:
                self.assertGreater(pathlib.Path(folder, picture).stat().st_size, 10000)

    test_pareto = needs("scipy")(lambda self: self.run_example("pareto.py", "--picture"))
    test_robust = needs("scipy")(lambda self: self.run_example("robust.py"))
    test_fujiwara_kawase = needs("scipy")(lambda self: self.run_example("fujiwara_kawase.py"))
    test_openmdao = needs("openmdao")(lambda self: self.run_example("openmdao_bearing.py"))

    def test_wear(self):
        self.run_example("wear.py", "--picture")

    @needs("matplotlib")
    def test_pictures(self):
        """Lines and colours are those of the tables."""
        import matplotlib
        matplotlib.use("Agg")
        import snug.plot
        flat = {"x": [1., 0., 2.], "y": [0., 0., .1], "pressure": [3., 1., 2.]}
        line, = snug.plot.pressure(flat).lines
        self.assertEqual(line.get_xydata().tolist(), [[0., 1.], [1., 3.], [2., 2.]])
        space = {"x": [0., 0., 0., 0.], "y": [0., 1., 0., 1.], "z": [0., 0., 2., 2.],
                 "pressure": [1., 2., 3., 4.]}
        axes = snug.plot.pressure(space)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("z", "y"))
        self.assertEqual(axes.collections[0].get_array().tolist(), [1., 2., 3., 4.])
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {"summary.json": "{}", "profile.csv": "reference_x,reference_y,move\n"
                               "1,0,5\n0,0,4\n", "history.csv": "evaluations,objective,"
                               "projected_gradient\n1,3,1\n2,2,.1\n"}.items():
                pathlib.Path(folder, name).write_text(text)
            for draw, points in ((snug.plot.shape, [[0., 4.], [1., 5.]]),
                                 (snug.plot.convergence, [[1., 3.], [2., 2.]])):
                line, = draw(snug.read(folder)).lines
                self.assertEqual(line.get_xydata().tolist(), points)

    @needs("tesseract_core")
    def test_tesseract(self):
        from tesseract_core import Tesseract
        with tempfile.TemporaryDirectory() as folder, snug.Model(SCENE, HERTZ) as model:
            file = pathlib.Path(folder, "model.prm")
            file.write_text(SCENE.read_text().replace("20, 20, 20", "4, 4, 4"))
            os.environ.update(SNUG_MODEL=str(file), SNUG_RESPONSES="potential energy,volume")
            with Tesseract.from_tesseract_api(EXAMPLES / "tesseract_api.py",
                                              output_path=folder) as served:
                x, factors = np.linspace(-.01, .01, 9), np.array([2., 3.])
                known = model.evaluate(x, gradients=True)
                found = served.apply({"x": x})["responses"]
                self.assertEqual(found.tolist(), [known["potential energy"], known["volume"]])
                found = served.vector_jacobian_product(
                    {"x": x}, ["x"], ["responses"], {"responses": factors})["x"]
                self.assertTrue(np.allclose(found, 2. * known.gradients["potential energy"]
                                            + 3. * known.gradients["volume"], 1e-14))
                forward = served.jacobian_vector_product({"x": x}, ["x"], ["responses"], {"x": x})
                self.assertAlmostEqual(factors @ forward["responses"], found @ x, 12)

    @needs("mcp")
    def test_mcp(self):
        import asyncio
        from mcp.client import Client
        from mcp.client.stdio import StdioServerParameters, stdio_client

        async def talk():
            settings = [f"{name}={snug.model.text_of(value)}" for name, value in HERTZ.items()]
            transport = stdio_client(StdioServerParameters(
                command=sys.executable, args=[str(EXAMPLES / "mcp_server.py"), str(SCENE), *settings],
                env={**os.environ, "PYTHONPATH": str(HERE.parent)}))
            async with Client(transport) as client:
                tools = await client.list_tools()
                about = await client.call_tool("describe", {})
                first = await client.call_tool("evaluate", {"gradients": ["volume"]})
                volume = first.structured_content["values"]["volume"]
                best = await client.call_tool("optimize", {
                    "objective": "potential energy", "limits": {"volume": [volume, volume]}})
                image = await client.call_tool("picture", {"x": best.structured_content["x"]})
                refused = await client.call_tool("evaluate", {"x": [1.]})
            return tools, about, first, best, image, refused

        tools, about, first, best, image, refused = asyncio.run(talk())
        self.assertIn("there are 9 design variables", refused.content[0].text)
        self.assertEqual({tool.name for tool in tools.tools},
                         {"describe", "evaluate", "optimize", "picture"})
        self.assertEqual(len(about.structured_content["variables"]), 9)
        self.assertEqual(len(first.structured_content["gradients"]["volume"]), 9)
        self.assertTrue(best.structured_content["converged"])
        self.assertAlmostEqual(best.structured_content["values"]["potential energy"], -1.21388658141, 8)
        self.assertEqual(image.content[0].mime_type, "image/png")


if __name__ == "__main__":
    unittest.main()
