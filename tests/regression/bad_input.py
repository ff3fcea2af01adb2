#!/usr/bin/env python3
"""Exit statuses and error messages: bad_input.py SNUG SCENE [UNSOLVABLE...].

Every wrong input ends with status 2 after less than 2 s and leaves one line on
standard error that names the file, the entry and the value; a problem without a
solution ends with 3. On several ranks the line is printed once. Runs on equally many ranks share
a start of stability.many, which SNUG_MANY names, or that of build/; a few start the program."""

import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "contrib/lib" / folder)
                for folder in ("", "stability")]

from border_entries import (comma_cases, mesh_texts, odd_cases,  # noqa: E402
                            place_cases)
from many import End, run_many  # noqa: E402
from runs import sample  # noqa: E402
from wrong_entries import (input_cases, option_cases, partial_cases,  # noqa: E402
                           setup_cases)

# CPU seconds, so that a busy machine fails nothing; the program itself starts
# in about half of one.
MAX_SECONDS = 2.

# What mpirun says of an exit status; Open MPI 5 has no option against it.
REPORT = re.compile(r"^-{60,}\n(?:.*\n)*?-{60,}\n", re.MULTILINE)

MESHES = ROOT / "tests/meshes"
ADAPTED = MESHES.parent / "scenes" / "adapted-2d.prm"


class Runner:
    """Runs the program on variants of the scene and counts what is wrong."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)
        self.text = options.scene.read_text(encoding="utf-8")
        self.checked = self.failed = 0
        self.waiting = {1: [], 3: []}

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
            command = [self.options.mpiexec, "-np", str(ranks), *command]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              cwd=self.folder, timeout=120, check=False)
        done.stderr = REPORT.sub("", done.stderr)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return done, (after.ru_utime + after.ru_stime - before.ru_utime
                      - before.ru_stime)

    def verdict(self, title, problems, said):
        self.checked += 1
        if problems:
            self.failed += 1
            print(f"FAILED {title}: {'; '.join(problems)}")
            print(f"  standard error: {said!r}")

    def expect_error_alone(self, title, arguments, names, ranks=1):
        """The program of its own ends with status 2 and one line that has all names."""
        done, seconds = self.run(arguments, ranks)
        said = [line for line in done.stderr.splitlines() if line.strip()]
        self.check_error(f"{title}, started alone", ranks, names, 2,
                         End(done.returncode, seconds, len(said), done.stderr))

    def expect_error(self, title, arguments, names, status=2, ranks=1):
        """The same of a run that examine_waiting starts with all others on so many ranks."""
        self.waiting[ranks].append((title, list(map(str, arguments)), names, status))

    def examine_waiting(self):
        for ranks, waiting in self.waiting.items():
            ends = run_many([arguments for _, arguments, _, _ in waiting], ranks, self.folder)
            for (title, _, names, status), end in zip(waiting, ends):
                self.check_error(title, ranks, names, status, end)

    def check_error(self, title, ranks, names, status, end):
        problems = []
        if end.status != status:
            problems.append(f"status {end.status}, not {status}")
        if end.lines != 1:
            problems.append(f"{end.lines} lines on standard error, not 1")
        problems += [f"'{name}' is not named" for name in names
                     if name not in end.message]
        if status == 2 and ranks == 1 and end.seconds > MAX_SECONDS:
            problems.append(f"takes {end.seconds:.1f} s")
        self.verdict(title + (f" ({ranks} ranks)" if ranks > 1 else ""), problems, end.message)

    def expect_success(self, title, arguments, in_output=""):
        done, _ = self.run(arguments)
        problems = []
        if done.returncode != 0:
            problems.append(f"status {done.returncode}, not 0")
        if done.stderr.strip():
            problems.append("says something on standard error")
        if in_output not in done.stdout:
            problems.append(f"'{in_output}' is not in the output")
        self.verdict(title, problems, done.stderr)


def check_case(runner, case, ranks=1):
    scene = runner.write(case.title, case.entries)
    names = [*case.names, scene.name] if case.entries else case.names
    runner.expect_error(case.title, [scene, *case.options], names, ranks=ranks)


def check_files(runner, scene):
    """Files that are not there, cannot be written or cannot be parsed."""
    for ranks in 1, 3:
        runner.expect_error_alone("missing file", ["nowhere.prm"], ["nowhere.prm"], ranks)
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
    good = (MESHES / "block-unnamed.msh").read_text(encoding="utf-8")
    first = "5 5 2 1 1 1 9 10 3 5 11 12 8"
    flat = good.replace("\n6\n", "\n4\n").split(first)[0] + "$EndElements\n"
    cases = [
        ("truncated mesh", good[:good.index(first) + 13], {}, ["line 25"]),
        ("inverted cell", good.replace(first, "5 5 2 1 1 5 11 12 8 1 9 10 3"), {},
         ["line 25", "element 5", "inverted"]),
        ("surface mesh", flat, {}, ["4 quadrilaterals"]),
        ("boundary not in the file", good, {"Supports": "left: x"},
         ["left", "bottom, top, free"]),
        ("cells of a region without a material", good.replace(
            "6 5 2 1", "6 5 2 9"), {"Materials": "group-1: steel"},
         ["the region 'group-9' has no material"]),
        ("units that put bodies far apart", good, {"Shift": "0, 0, 1000"},
         ["part.bottom", "z 1000", "distance of 999", "Scale"]),
        ("boundary set that is not in the file", good, {"Boundary sets": "group-2, 7"},
         ["'7' is not a set", "the sets are group-2, group-3"]),
        ("group that is no boundary set", good, {"Boundary sets": "group-2"},
         ["top", "bottom, free"]),
        ("curved face of a mesh file", good, {"Curved faces": "top: sphere"},
         ["top: sphere", "is for boxes"])]
    for title, mesh, entries, names in cases:
        path = runner.folder / (title.replace(" ", "-") + ".msh")
        path.write_text(mesh, encoding="utf-8")
        scene = mesh_scene(runner, title, {"File": path.name, **entries})
        place = [] if "Shift" in entries else [scene.name]
        if len(entries) == 0:
            place.append(path.name)
        runner.expect_error(title, [scene], [*place, *names])
        runner.expect_error(title, ["--validate", scene], names, ranks=3)
    for title, file, mesh, entries, names in mesh_texts():
        (runner.folder / file).write_text(mesh, encoding="utf-8")
        scene = mesh_scene(runner, title, {"File": file, **entries})
        runner.expect_error(title, [scene], [scene.name, *names])
    scene = mesh_scene(runner, "group without a name", {
        "File": MESHES / "block-unnamed.msh", "Boundary names": "2: bottom",
        "Pressure": "group-3: 1"})
    runner.expect_success("group without a name", ["--validate", scene], "  group-3  area")
    scene = mesh_scene(runner, "a mesh without end", {"File": "/dev/zero"})
    runner.expect_error("mesh of a device", [scene],
                           [scene.name, "/dev/zero", "must be a regular file"])
    runner.expect_error("parameters without end", ["/dev/zero"],
                        ["/dev/zero", "more than 16 MB"], ranks=3)
    scene = mesh_scene(runner, "no such mesh", {"File": "nowhere.msh"})
    runner.expect_error("missing mesh file", [scene],
                        [scene.name, "nowhere.msh"], ranks=3)


def check_cad_files(runner):
    """CAD files and entries that are wrong; a gmsh that is missing or fails."""
    good = {"Mesh": "cad", "File": MESHES / "pins.step", "Solid": 2, "Boundary names": "",
            "CAD faces": "bottom: 5; top: 6", "Element size": 1}
    cases = [
        ("no such solid", {"Solid": 3}, ["Solid", "3", "at most 2"]),
        ("no choice of a solid", {"Solid": 0}, ["Solid", "contains 2"]),
        ("element size of zero", {"Element size": 0}, ["Element size", "must be positive"]),
        ("face in two boundaries", {"CAD faces": "bottom: 5 + 6; top: 6"},
         ["CAD faces", "face 6", "'bottom'"]),
        ("surface of a CAD face", {"Surface": "top: smooth"}, ["Surface", "for mesh files"]),
        ("mesh file as CAD file", {"File": MESHES / "block.inp"}, ["block.inp", "'Mesh = file'"])]
    for title, entries, names in cases:
        scene = mesh_scene(runner, title, {**good, **entries})
        runner.expect_error(title, ["--validate", scene], [scene.name, *names],
                            ranks=3 if title == "no such solid" else 1)
    scene = mesh_scene(runner, "no gmsh", good)
    path = os.environ["PATH"]
    for title, program, words in (("no gmsh", None, ["gmsh", "cannot be started"]),
                                  ("failing gmsh", "#!/bin/sh\necho 'Error   : no room'; exit 1\n",
                                   ["gmsh", "status 1", "no room"])):
        folder = runner.folder / title.replace(" ", "-")
        folder.mkdir()
        for needed in ("orted", "ssh", "rsh"):  # of Open MPI, also without mpirun
            if found := shutil.which(needed, path=path):
                (folder / needed).symlink_to(found)
        if program:
            (folder / "gmsh").write_text(program, encoding="utf-8")
            (folder / "gmsh").chmod(0o755)
        os.environ["PATH"] = str(folder)
        runner.expect_error_alone(title, ["--validate", scene], [scene.name, *words])
        os.environ["PATH"] = path


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
    """Only a design that meets its constraints, and a state its tolerance, ends with
    0."""
    runner.expect_error("too few F-mults",
                        [scene, "--set", "Solver/Maximum F-mults=3"],
                        ["in 3 F-mults", "increase 'Maximum F-mults'"], 3)
    plane = ("0, 0, 1.8", "0, 0, -1")
    runner.expect_error("the same obstacle twice", [runner.write("twice", {
        "Obstacles": "a, b", "Contact/Pairs":
        ", ".join([runner.entry("Pairs"), "upper.top: a", "upper.top: b"]),
        **{f"Obstacle {name}/{entry}": value for name in "ab"
           for entry, value in zip(("Point", "Normal"), plane)}})],
        ["two contact rows the same"], 3)
    settings = ["Task=optimize", "Optimization/Maximum evaluations=1",
                "Optimization/Constraints=volume: = 1.5 initial"]
    run = [scene, *(word for entry in settings for word in ("--set", entry))]
    for ranks in 1, 3:
        runner.expect_error("no design satisfies the limits", run,
                            ["maximum evaluations", "violates"], 3, ranks)
    runner.expect_success("constraints met", [
        *run, "--set", "Optimization/Constraints=volume: = initial"])


def check_targets(runner):
    """Targets that cannot be met say why, and what to try."""
    for title, entries, names in [
            ("too few unknowns", ["Maximum unknowns=300"],
             ["not met", "'Maximum unknowns'"]),
            ("too few levels", ["Maximum levels=4"], ["not met", "'Maximum levels'"]),
            ("a peak without bound", ["Target=edge: 1 %"], ["unbounded", "edge"]),
            ("a part of nothing", ["Target=still: 1 %"], ["still", "probably zero"])]:
        settings = ["Responses=edge, still", *(f"Accuracy/{entry}" for entry in entries),
                    "Response edge/Quantity=von Mises norm", "Response edge/Exponent=30",
                    "Response still/Quantity=displacement",
                    "Response still/Face=cylinder.left", "Response still/Component=x",
                    "Accuracy/Maximum unknowns=20000"]
        if title == "a peak without bound":
            # a flat punch: as large stresses at its edges as cells are small
            settings += ["Body cylinder/Curved faces=", "Body cylinder/Box size=0.5, 1"]
        if title == "too few unknowns":
            settings.pop()
        words = [word for setting in settings for word in ("--set", setting)]
        runner.expect_error(title, [ADAPTED, *words], names, 3)


def check_small_targets(runner):
    """Targets below the rounding of their responses are refused, relative ones at once."""
    for target, status, names in [
            ("1e-300 %", 2, ["'Accuracy/Target'", "1e-300 %", "at least 1e-8 %"]),
            ("9e-9 %", 2, ["'Accuracy/Target'", "9e-9 %", "at least 1e-8 %"]),
            ("1e-300", 3, ["the target 1e-300 of potential energy", "must be at least"])]:
        runner.expect_error("target too small", [
            ADAPTED, "--set", f"Accuracy/Target=potential energy: {target}"], names, status)


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
    runner.expect_success("a state without a load", [
        scene, "--output", results, "--set", "Task=state",
        "--set", "Body upper/Pressure="], "warning: all displacements are zero")
    check_pictures(runner, scene)
    runner.expect_success("what was read reads again",
                          ["--validate", results / "parameters.prm"])


def check_pictures(runner, scene):
    """Of an optimization: the first and the last design, and those asked for."""
    for every, more in (0, False), (1, True):
        folder = runner.folder / f"drawn-{every}"
        runner.expect_success(f"Draw every = {every}", [
            scene, "--output", folder, "--set", "Task=optimize",
            "--set", "Optimization/Maximum evaluations=5",
            "--set", f"Optimization/Draw every={every}"])
        drawn = (folder / "solution.pvd").read_text(encoding="utf-8")
        times = re.findall(r'timestep="([^"]*)"', drawn)
        if len(times) != len(set(times)) or (len(times) > 2) != more:
            runner.failed += 1
            print(f"FAILED Draw every = {every}: pictures at {times}")


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
        commas = comma_cases(bodies[0], slave, master)
        for case in sample(cases + commas + option_cases()):
            check_case(runner, case)
        for case in cases[:3] + cases[-5:-3]:
            check_case(runner, case, ranks=3)
        for case in sample(setup_cases(bodies[0], slave) + place_cases(bodies[0], slave)):
            check_case(runner, case._replace(options=["--validate"]))
        for title, entries, text in sample(odd_cases(bodies[0])):
            runner.expect_success(title, ["--validate", runner.write(title, entries)], text)
        # Wrong command lines end before MPI begins.
        scene_only = [scene, "--set", "Task=optimise"]
        runner.expect_error_alone("wrong value in a setting", scene_only, ["Task", "optimise"], 3)
        for case in sample(partial_cases(bodies[0])):
            check_case(runner, case, ranks=3)
            check_case(runner, case._replace(options=["--validate"]))
        check_files(runner, scene)
        check_mesh_files(runner)
        check_cad_files(runner)
        floating = {f"Body {body}/Supports": "" for body in bodies}
        runner.expect_error("no supports at all",
                            [runner.write("floating", floating)], [], status=3)
        check_unsolved(runner, scene)
        check_targets(runner)
        check_small_targets(runner)
        for path in options.unsolvable:
            runner.expect_error(path.name, [path.resolve()], [], status=3)
        runner.examine_waiting()
    print(f"{runner.checked} runs, {runner.failed} wrong")
    return 1 if runner.failed or not runner.checked else 0


if __name__ == "__main__":
    sys.exit(main())
