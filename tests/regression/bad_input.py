#!/usr/bin/env python3
"""Exit statuses and error messages: bad_input.py SNUG SCENE [UNSOLVABLE...].

Every wrong input ends with status 2 after less than 2 s and leaves one line on
standard error that names the file, the entry and the value; a problem without a
solution ends with 3. On several ranks the line is printed once."""

import argparse
import collections
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

# CPU seconds, so that a busy machine fails nothing; the program itself starts
# in about half of one.
MAX_SECONDS = 2.

# entries: {"Section/Entry": value} set at the end of the scene; names: what the
# message must hold.
Case = collections.namedtuple("Case", "title entries names options")


def wrong(title, path, value, names=(), others=()):
    """One wrong entry, after some others; the message names it and its value."""
    entries = {**{key: good for key, good in dict(others).items()
                  if key != path}, path: value}
    return Case(title, entries, [path.split("/")[-1], value, *names], [])


def input_cases(body, slave, master):
    """Wrong values of entries. @p body and the faces are the scene's."""
    shape = {"Task": "optimize", "Optimization/Objective": "potential energy",
             "Shape/Basis": "Bezier patch", "Shape/Face": master,
             "Shape/Control points": "2, 2", "Shape/Direction": "0, 0, 1",
             "Shape/Bounds": "-0.1, 0.1"}
    box = {**shape, "Shape/Basis": "Bezier box",
           "Shape/Box corner": "0, 0, 0", "Shape/Box size": "1, 1, 1",
           "Shape/Control points": "2, 2, 2"}
    own = f"Body {body}/"
    tip = {"Responses": "tip", "Response tip/Quantity": "displacement",
           "Response tip/Component": "x"}
    peak = {"Responses": "peak", "Response peak/Quantity": "peak pressure"}
    core = {"Materials": "steel", own + "Region formulas": "core: x - 0.5",
            own + "Young's modulus": "1"}
    return [
        wrong("unknown entry", own + "Yuong's modulus", "1"),
        Case("unknown subsection", {"Elastcity/Degree": "1"}, ["Elastcity"], []),
        wrong("misspelled choice", "Solver/Method", "active sett",
              ["active set", "SMALSE-M"]),
        wrong("wrong task", "Task", "optimise", ["optimize"]),
        wrong("wrong type", own + "Young's modulus", "stiff"),
        wrong("wrong type in a list", own + "Box cells", "2, two, 2"),
        wrong("half a number", "Decomposition/Subdomains", "2.5"),
        wrong("unknown body", "Contact/Pairs", f"{slave}: foundaton.top"),
        wrong("unknown boundary of a pair", "Contact/Pairs",
              f"{slave}: {master}_side"),
        wrong("unknown boundary of a support", own + "Supports", "topp: z"),
        wrong("unknown direction of a support", own + "Supports", "top: w"),
        wrong("displacement without a value", own + "Displacement", "top: z"),
        wrong("displacement of a held component", own + "Displacement",
              "left: x = 0.1", ["Supports"]),
        wrong("force without components", own + "Force", "top: 1"),
        wrong("load case without a body", "Load case a/Pressure", "x.top: 1",
              others={"Load cases": "a"}),
        wrong("body twice", "Bodies", f"{body}, {body}"),
        wrong("negative modulus", own + "Young's modulus", "-1"),
        wrong("modulus not a number", own + "Young's modulus", "nan"),
        wrong("infinite modulus", own + "Young's modulus", "inf"),
        wrong("pressure not a number", own + "Pressure", "top: nan"),
        wrong("Poisson's ratio of a fluid", own + "Poisson's ratio", "0.5"),
        wrong("Poisson's ratio too small", own + "Poisson's ratio", "-1"),
        wrong("unknown material", own + "Materials", "stele", ["steel"],
              {"Materials": "steel", own + "Young's modulus": "1"}),
        wrong("region without a material", own + "Materials", "core: steel",
              ["'body' has no material"], core),
        wrong("unknown region", own + "Materials", "body: steel, cor: steel",
              ["did you mean 'core'"], core),
        wrong("region twice", own + "Materials", "core: steel, core: steel",
              ["different regions"], core),
        wrong("modulus beside materials", own + "Young's modulus", "2",
              ["left out"], {"Materials": "steel", own + "Materials": "steel"}),
        wrong("material of no modulus", "Material steel/Young's modulus", "0",
              others={"Materials": "steel"}),
        wrong("pair of the same face", "Contact/Pairs", f"{slave}: {slave}"),
        wrong("model of another dimension", "Model", "axisymmetric", ["solid"]),
        wrong("thickness of a solid", "Thickness", "2", ["solid"]),
        wrong("unknown formulation", own + "Formulation", "b-bar", ["B-bar"]),
        wrong("obstacle that is not there", "Contact/Pairs",
              f"{slave}: floor", ["body.boundary"]),
        wrong("plane without normal", "Obstacle floor/Normal", "0, 0, 0",
              others={"Obstacles": "floor"}),
        wrong("gap that is no formula", "Contact/Gap", "2 * t",
              ["formula of x,y,z"]),
        wrong("zero cells", own + "Box cells", "0, 2, 2"),
        wrong("disc in 3D", own + "Mesh", "disc", ["Dimension = 2"]),
        wrong("hole larger than the ring", own + "Inner radius", "2",
              others={own + "Mesh": "ring", own + "Supports": ""}),
        wrong("no mesh file", own + "Mesh file", "",
              others={own + "Mesh": "file"}),
        wrong("flat box", own + "Box size", "1, 1, 0"),
        wrong("no tolerance", "Solver/Relative tolerance", "0"),
        wrong("a scaled Jacobian no mesh has", "Least scaled Jacobian", "1.5"),
        wrong("empty bounds", "Shape/Bounds", "0.1, -0.1", others=shape),
        wrong("initial design outside the bounds", "Shape/Initial", "0.2",
              others=shape),
        wrong("unknown objective", "Optimization/Objective", "beauty",
              ["potential energy"], shape),
        wrong("unknown response in a constraint", "Optimization/Constraints",
              "weight: initial", ["volume"], shape),
        wrong("unknown quantity", "Response tip/Quantity", "displacment",
              ["displacement"], tip),
        wrong("response without its place", "Optimization/Objective",
              "displacement", ["needs a subsection Response"], shape),
        wrong("point outside the bodies", "Response tip/Point", "0, 0, 99",
              ["outside the bodies"], tip),
        wrong("point in two bodies", "Response tip/Point", "0.5, 0.5, 1",
              ["name one"], tip),
        wrong("unknown body of a response", "Response weight/Body", "hammer",
              others={"Responses": "weight",
                      "Response weight/Quantity": "mass"}),
        wrong("unknown face of a response", "Response tip/Face", f"{body}.x",
              others=tip),
        wrong("constraint on a missing pair", "Response peak/Pair",
              f"{slave}: {slave}", ["no such pair"],
              {**shape, **peak, "Optimization/Constraints": "peak: <= 1"}),
        wrong("p below 1", "Response peak/Exponent", "0.5", others=peak),
        wrong("entry a response does not read", "Response peak/Body", body,
              ["left out"], peak),
        wrong("limit that is none", "Optimization/Constraints", "volume: < 1",
              ["<= 120"], shape),
        wrong("equality where there can be none", "Optimization/Constraints",
              "volume: initial", ["MMA"],
              {**shape, "Optimization/Algorithm": "MMA"}),
        wrong("unknown face to shape", "Shape/Face", f"{body}.x", others=shape),
        wrong("box without a size", "Shape/Box size", "1, 0, 1", others=box),
        wrong("box beside the bodies", "Shape/Box size", "1, 1, 2",
              ["no node"], {**box, "Shape/Box corner": "90, 0, 0"}),
        wrong("all control points fixed", "Shape/Fixed", "border",
              ["nothing is left"], shape),
        wrong("filter without a radius", "Shape/Filter radius", "0",
              others={**shape, "Shape/Basis": "node-wise",
                      "Shape/Control points": ""}),
        wrong("mirror plane off the middle", "Shape/Symmetry", "x: 0.123",
              ["no image"], shape),
    ]


def option_cases():
    """Wrong command lines; the message has the wrong word."""
    return [
        Case("unknown option", {}, ["--outptu"], ["--outptu", "x"]),
        Case("option without its value", {}, ["--output"], ["--output"]),
        Case("malformed setting", {}, ["Task"], ["--set", "Task"]),
        Case("unknown entry in a setting", {}, ["--set", "Yuong"],
             ["--set", "Yuong=4711"]),
        Case("wrong value in a setting", {}, ["Task", "optimise"],
             ["--set", "Task=optimise"]),
    ]


MESHES = pathlib.Path(__file__).resolve().parents[1] / "meshes"


class Runner:
    """Runs the program on variants of the scene and counts what is wrong."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)
        self.text = options.scene.read_text(encoding="utf-8")
        self.checked = self.failed = 0

    def entry(self, name):
        return re.search(rf"^\s*set\s+{name}\s*=\s*([^#\n]*)", self.text,
                         re.MULTILINE).group(1).strip()

    def write(self, title, entries):
        """A scene that differs from the good one in these entries."""
        text = self.text.rstrip("\n") + "\n"
        for path, value in entries.items():
            section, _, name = path.rpartition("/")
            line = f"set {name} = {value}\n"
            text += f"subsection {section}\n{line}end\n" if section else line
        return self.write_text(title, text)

    def write_text(self, title, text):
        path = self.folder / (re.sub(r"\W+", "-", title) + ".prm")
        path.write_text(text, encoding="utf-8")
        return path

    def run(self, arguments, ranks=1):
        """(process, CPU seconds); on several ranks through mpiexec."""
        command = [self.options.program, *map(str, arguments)]
        if ranks > 1:
            # -q: mpirun's own report of the exit status is not ours.
            command = [self.options.mpiexec, "-q", "-np", str(ranks), *command]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              cwd=self.folder, timeout=120, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return done, (after.ru_utime + after.ru_stime - before.ru_utime
                      - before.ru_stime)

    def verdict(self, title, problems, done):
        self.checked += 1
        if problems:
            self.failed += 1
            print(f"FAILED {title}: {'; '.join(problems)}")
            print(f"  standard error: {done.stderr!r}")

    def expect_error(self, title, arguments, names, status=2, ranks=1):
        """The run ends with status and one line that has all names."""
        done, seconds = self.run(arguments, ranks)
        problems = []
        if done.returncode != status:
            problems.append(f"status {done.returncode}, not {status}")
        said = [line for line in done.stderr.splitlines() if line.strip()]
        if len(said) != 1:
            problems.append(f"{len(said)} lines on standard error, not 1")
        problems += [f"'{name}' is not named" for name in names
                     if name not in done.stderr]
        if status == 2 and ranks == 1 and seconds > MAX_SECONDS:
            problems.append(f"takes {seconds:.1f} s")
        self.verdict(title + (f" ({ranks} ranks)" if ranks > 1 else ""),
                     problems, done)

    def expect_success(self, title, arguments, in_output=""):
        done, _ = self.run(arguments)
        problems = []
        if done.returncode != 0:
            problems.append(f"status {done.returncode}, not 0")
        if done.stderr.strip():
            problems.append("says something on standard error")
        if in_output not in done.stdout:
            problems.append(f"'{in_output}' is not in the output")
        self.verdict(title, problems, done)


def check_case(runner, case, ranks=1):
    scene = runner.write(case.title, case.entries)
    names = [*case.names, scene.name] if case.entries else case.names
    runner.expect_error(case.title, [scene, *case.options], names, ranks=ranks)


def check_files(runner, scene):
    """Files that are not there, cannot be written or cannot be parsed."""
    runner.expect_error("missing file", ["nowhere.prm"], ["nowhere.prm"])
    runner.expect_error("missing file", ["nowhere.prm"], ["nowhere.prm"],
                        ranks=3)
    runner.expect_error("a directory as file", [runner.folder],
                        [str(runner.folder)])
    runner.expect_error("no file at all", [], [])
    # Below a file nobody can make a directory, not even root.
    blocked = scene / "results"
    runner.expect_error("unwritable output directory",
                        [scene, "--output", blocked], [str(blocked)])
    runner.expect_error("unwritable output directory", [scene, "--output",
                                                        blocked],
                        [str(blocked)], ranks=3)
    open_end = runner.write_text("no end", "subsection Solver\n")
    runner.expect_error("subsection without end", [open_end], [open_end.name])
    no_set = runner.write_text("no set", runner.text + "\nTask : state\n")
    runner.expect_error("line that is no statement", [no_set],
                        [no_set.name, "Task : state"])


def check_mesh_files(runner):
    """Mesh files that are wrong: the message names the file and the place."""
    good = (MESHES / "block.ucd").read_text(encoding="utf-8")
    first = "5 1 hex 1 9 10 3 5 11 12 8"
    flat = good.replace("12 6 0", "12 4 0").split("5 1 hex")[0]
    cases = [
        ("truncated mesh", good[:good.index(first) + 9], {}, ["line 19"]),
        ("inverted cell", good.replace(first, "5 1 hex 5 11 12 8 1 9 10 3"), {},
         ["line 19", "element 5", "inverted"]),
        ("surface mesh", flat, {}, ["4 quadrilaterals"]),
        ("missing physical name", good, {"Boundary names": "3: top"},
         ["line 15", "group 2"]),
        ("boundary not in the file", good, {"Supports": "left: x"},
         ["left", "bottom, top, free"]),
        ("cells of a region without a material", good.replace(
            "6 1 hex", "6 9 hex"), {"Materials": "1: steel"},
         ["the region '9' has no material"]),
        ("units that put bodies far apart", good, {"Shift": "0, 0, 1000"},
         ["part.bottom", "999 apart", "Scale"]),
        ("face that is not round", good, {"Curved faces": "top: sphere"},
         ["top: sphere", "does not fit"])]
    for title, mesh, entries, names in cases:
        path = runner.folder / (title.replace(" ", "-") + ".ucd")
        path.write_text(mesh, encoding="utf-8")
        scene = mesh_scene(runner, title, {"Mesh file": path.name, **entries})
        place = [] if "Shift" in entries else [scene.name]
        if len(entries) == 0:
            place.append(path.name)
        runner.expect_error(title, [scene], [*place, *names])
        runner.expect_error(title, ["--validate", scene], names, ranks=3)
    scene = mesh_scene(runner, "no such mesh", {"Mesh file": "nowhere.msh"})
    runner.expect_error("missing mesh file", [scene],
                        [scene.name, "nowhere.msh"], ranks=3)


def mesh_scene(runner, title, entries):
    """A body of a mesh file with these entries on a box."""
    part = {"Mesh": "file", "Boundary names": "2: bottom, 3: top",
            "Shift": "0, 0, 1", "Pressure": "top: 1", **entries}
    return runner.write_text(title, "\n".join(
        ["set Bodies = part, base", "set Materials = steel",
         "subsection Body part",
         *(f"set {name} = {value}" for name, value in part.items()), "end",
         "subsection Body base", "set Box cells = 2, 2, 2",
         "set Box size = 2, 1, 1", "set Supports = bottom: xyz", "end",
         "subsection Contact", "set Pairs = part.bottom: base.top", "end", ""]))


def check_unsolved(runner, scene):
    """Only a design that meets its constraints ends with 0."""
    settings = ["Task=optimize", "Optimization/Maximum evaluations=1",
                "Optimization/Constraints=volume: = 1.5 initial"]
    run = [scene, *(word for entry in settings for word in ("--set", entry))]
    for ranks in 1, 3:
        runner.expect_error("constraints violated", run,
                            ["maximum evaluations", "violates"], 3, ranks)
    runner.expect_success("constraints met", [
        *run, "--set", "Optimization/Constraints=volume: = initial"])


def check_good(runner, scene):
    """What is right ends with 0 and says nothing on standard error."""
    runner.expect_success("--help", ["--help"], "--validate")
    runner.expect_success("--version", ["--version"], "snug")
    runner.expect_success("--print-parameters", ["--print-parameters"],
                          "Relative tolerance")
    runner.expect_success("--validate", ["--validate", scene], "area")
    results = runner.folder / "results"
    runner.expect_success("a state", [scene, "--output", results,
                                      "--set", "Task=state"])
    for name in ("summary.json", "parameters.prm", "solution.pvd",
                 "contact.pvd"):
        if not (results / name).is_file():
            runner.failed += 1
            print(f"FAILED a state: leaves no {name}")
    runner.expect_success("what was read reads again",
                          ["--validate", results / "parameters.prm"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("unsolvable", nargs="*", type=pathlib.Path,
                        help="scenes without an equilibrium")
    parser.add_argument("--mpiexec", default="mpirun")
    options = parser.parse_args()
    options.program = str(pathlib.Path(options.program).resolve())
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(options, folder)
        scene = runner.write("good", {})
        bodies = re.split(r"\s*,\s*", runner.entry("Bodies"))
        slave, master = re.split(r"\s*[:,]\s*", runner.entry("Pairs"))[:2]
        check_good(runner, scene)
        cases = input_cases(bodies[0], slave, master)
        for case in cases + option_cases():
            check_case(runner, case)
        for case in cases[:3] + cases[-5:-3]:
            check_case(runner, case, ranks=3)
        check_files(runner, scene)
        check_mesh_files(runner)
        floating = {f"Body {body}/Supports": "" for body in bodies}
        runner.expect_error("no supports at all",
                            [runner.write("floating", floating)], [], status=3)
        check_unsolved(runner, scene)
        for path in options.unsolvable:
            runner.expect_error(path.name, [path.resolve()], [], status=3)
    print(f"{runner.checked} runs, {runner.failed} wrong")
    return 1 if runner.failed or not runner.checked else 0


if __name__ == "__main__":
    sys.exit(main())
