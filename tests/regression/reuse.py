#!/usr/bin/env python3
"""What a run finds in its output directory: reuse.py SNUG.

A restart goes on where the folder of scene, mesh and results has been moved,
and without a warm start that was cut short; it is refused where the text of the
mesh file has changed. A run that begins anew removes the results of earlier
ones, and nothing else. A sensitivity
run has a gradient, whatever its method."""

import json
import pathlib
import subprocess
import sys
import tempfile

CELLS = (6, 4)

SCENE = """
set Task             = optimize
set Dimension        = 2
set Bodies           = upper, lower
set Output directory = output

subsection Body upper
  set Box corner   = 0.2, 1
  set Box size     = 0.6, 0.5
  set Box cells    = 6, 4
  set Curved faces = bottom: cylinder z 4
  set Young's modulus = 2000
  set Supports     = left: x, right: x
  set Pressure     = top: 20
end
subsection Body lower
  set Mesh            = file
  set File            = block.msh
  set Young's modulus = 1000
  set Supports        = bottom: xy
end
subsection Contact
  set Pairs = upper.bottom: lower.top
end
subsection Shape
  set Basis    = formula modes
  set Face     = lower.top
  set Modes    = 0, x*(1-x); 0, x^2*(1-x); 0, x^3*(1-x)
  set Interior = Laplace
  set Bounds   = -0.2, 0.2
end
subsection Optimization
  set Constraints = volume: initial
end
"""


def mesh_text(height):
    """A block [0, 1] x [0, height] in the format 2.2 of Gmsh."""
    nx, ny = CELLS

    def node(i, j):
        return 1 + i + (nx + 1) * j

    nodes = [f"{node(i, j)} {i / nx} {height * j / ny} 0"
             for j in range(ny + 1) for i in range(nx + 1)]
    elements = [f"1 2 {tag} {tag} {node(i, j)} {node(i + 1, j)}"
                for tag, j in ((1, 0), (2, ny)) for i in range(nx)]
    elements += [f"3 2 3 3 {node(i, j)} {node(i + 1, j)} {node(i + 1, j + 1)} {node(i, j + 1)}"
                 for j in range(ny) for i in range(nx)]
    elements = [f"{number} {text}" for number, text in enumerate(elements, 1)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3",
                      '1 1 "bottom"', '1 2 "top"', '2 3 "block"', "$EndPhysicalNames",
                      "$Nodes", str(len(nodes)), *nodes, "$EndNodes",
                      "$Elements", str(len(elements)), *elements, "$EndElements", ""])


class Checks:
    def __init__(self, program, folder):
        self.program = program
        self.folder = folder
        self.failed = 0

    def run(self, *options):
        """The finished process, run in the folder."""
        return subprocess.run([self.program, "scene.prm", *options], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120,
                              check=False)

    def expect(self, what, good, done):
        print(("ok" if good else "FAILED") + ": " + what)
        if not good:
            self.failed += 1
            print(f"  status {done.returncode}\n{done.stdout}{done.stderr}")

    def interrupted(self, evaluations, *more):
        return self.run("--set", f"Optimization/Maximum evaluations={evaluations}", *more)

    def summary(self):
        return json.loads((self.folder / "output/summary.json").read_text())


def check_restarts(checks):
    checks.interrupted(2)
    mesh = checks.folder / "block.msh"
    mesh.write_text(mesh_text(0.99))
    done = checks.interrupted(3, "--restart")
    checks.expect("a restart with another mesh in the same file is refused",
                  done.returncode == 2 and "another problem" in done.stderr, done)
    mesh.write_text(mesh_text(1.))
    moved = checks.folder.with_name("moved")
    checks.folder.rename(moved)
    checks.folder = moved
    done = checks.interrupted(3, "--restart")
    checks.expect("a restart in a folder that was moved goes on",
                  "reusing" in done.stdout and
                  checks.summary()["optimization"]["evaluations"] == 3, done)
    for start in moved.glob("output/warm-start.*"):
        start.write_bytes(start.read_bytes()[:-3])
    done = checks.interrupted(4, "--restart")
    checks.expect("a warm start that is cut short is not taken",
                  "no warm-start data" in done.stdout and
                  checks.summary()["optimization"]["evaluations"] == 4, done)


def check_old_results(checks):
    output = checks.folder / "output"
    ours = ["solution-0007.pvtu", "solution-0007.vtm", "solution-0007/00-punch.0000.vtu",
            "contact-0008/01-a.b_c.0000.vtu", "contact-0007.csv", "surface.stl", "warm-start.7.1"]
    others = ["solution-0007.png", "contact.csv", "my-history.csv", "solution-7.pvtu.bak",
              "solution-0007/my-notes.txt", "solution-0007.d/00-punch.0000.vtu"]
    for name in ours + others:
        (output / name).parent.mkdir(exist_ok=True)
        (output / name).write_text("old")
    done = checks.run("--set", "Task=state")
    left = {str(path.relative_to(output)) for path in output.rglob("*")}
    checks.expect("results of earlier runs are removed",
                  done.returncode == 0 and not left.intersection(
                      [*ours, "contact-0008", "journal.txt", "history.csv",
                       "solution-0001.pvtu"]), done)
    checks.expect("what others left is not", left.issuperset(
        [*others, "solution-0000.pvtu", "summary.json", "parameters.prm"]), done)


def check_gradients(checks):
    for method in ("adjoint", "direct", "finite differences"):
        done = checks.run("--set", "Task=sensitivity", "--set", "Optimization/Objective=volume",
                          "--set", "Optimization/Constraints=compliance: initial",
                          "--set", f"Gradient/Method={method}")
        values = checks.summary()["gradient"]["values"]
        checks.expect(f"volume has a gradient by {method}",
                      done.returncode == 0 and values and len(values) == 3, done)


def main():
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work, "first")
        folder.mkdir()
        (folder / "scene.prm").write_text(SCENE)
        (folder / "block.msh").write_text(mesh_text(1.))
        checks = Checks(sys.argv[1], folder)
        for check in (check_restarts, check_old_results, check_gradients):
            check(checks)
    return 1 if checks.failed else 0


if __name__ == "__main__":
    sys.exit(main())
