#!/usr/bin/env python3
"""Compile without linking, to find what the build does not show.

compile.py alone: every source compiles by itself, as without unity builds, and
every header, where no source includes it first. compile.py tidy: clang-tidy with
the checks of .clang-tidy finds nothing. Prints what the compilers say; exit
status 1 if they find something."""

import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys

from files import lines, text_files

ROOT = pathlib.Path(__file__).resolve().parents[2]
OF_MODULE = re.compile(r" -o \S*/snug_(\w+)\.dir/")
INCLUDE = re.compile(r"\s*#\s*include\s*[<\"]([^>\"]+)")


def entries(build):
    """(module, compilation database entry) of all objects of the modules."""
    database = json.loads((build / "compile_commands.json").read_text())
    for entry in database:
        module = OF_MODULE.search(entry["command"])
        if module and "cmake_pch" not in entry["file"]:
            yield module.group(1), entry


def flags(entry):
    """Its compiler with options, without input, output and precompiled headers."""
    words = shlex.split(entry["command"])
    drop = {"-o": 2, "-include": 2, "-c": 1, "-Winvalid-pch": 1, entry["file"]: 1}
    kept = []
    while words:
        skip = drop.get(words[0], 0)
        if not skip and not words[0].endswith("ccache"):
            kept.append(words[0])
        words = words[max(skip, 1):]
    return kept


def module_of(root, path):
    parts = path.relative_to(root).parts
    return parts[2 if parts[0] == "include" else 1]


def first_include(path):
    found = (INCLUDE.match(line) for _, line in lines(path))
    return next((include.group(1) for include in found if include), None)


def lone_files(root):
    """All sources, and the headers that are no source's first include: those
    are compiled alone with it."""
    sources = list(text_files(root, ("source",), (".cc",)))
    first = {first_include(path) for path in sources}
    return sources + [path for path in text_files(root, ("include",), (".h",))
                      if str(path.relative_to(root / "include")) not in first]


def run(command):
    """What a compiler says, if it is not content."""
    done = subprocess.run(command, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    said = done.stdout + done.stderr
    return said.strip() if done.returncode or "warning:" in said else ""


def alone(root, build, files):
    """Commands that compile each file by itself."""
    of_module = {module: flags(entry) for module, entry in entries(build)}
    return [of_module[module_of(root, path)] +
            ["-fsyntax-only", "-x", "c++", str(path)]
            for path in lone_files(root) if files is None or path in files]


def parts(source, folder, files):
    """Return sources for clang-tidy that include the files of an object, or those that are asked
    for, eight in each: clang refuses a unity source that makes members of a class before the
    class."""
    names = [str(source)]
    if source.parent.name == "Unity":
        names = re.findall(r'#include "(.*)"', source.read_text())
    names = [name for name in names if files is None or pathlib.Path(name) in files]
    result = []
    for first in range(0, len(names), 8):
        part = folder / f"{source.parents[1].name}-{source.stem}-{first}.cxx"
        part.write_text("".join(f"#include \"{name}\"\n" for name in names[first:first + 8]))
        result.append(part)
    return result


def tidy(root, build, files):
    """Commands for sources that include several files, and so read the headers of deal.II once.
    clang does not know all of gcc's options and warnings: only those that find headers remain."""
    folder = build / "lint"
    folder.mkdir(exist_ok=True)
    database = []
    for _, entry in entries(build):
        words = flags(entry)
        kept = [word for before, word in zip([""] + words, words)
                if word[:2] in ("-I", "-D") or word == "-isystem" or
                before == "-isystem"]
        for part in parts(pathlib.Path(entry["file"]), folder, files):
            database.append({"directory": entry["directory"], "file": str(part),
                             "arguments": ["clang++", "-std=c++17", *kept, "-c", str(part)]})
    (folder / "compile_commands.json").write_text(json.dumps(database))
    return [["clang-tidy-19", "--quiet", f"--config-file={root / '.clang-tidy'}",
             "-p", str(folder), entry["file"]] for entry in database]


def most_changed(root, n):
    """The n sources in which the last ten commits changed most lines; none without git."""
    if not (root / ".git").exists():
        return set()
    log = subprocess.run(["git", "-C", str(root), "log", "-10", "--no-merges", "--numstat",
                          "--format=", "--", "source/*.cc"],
                         text=True, stdout=subprocess.PIPE, check=True).stdout
    changed = collections.Counter()
    for added, deleted, name in (line.split("\t") for line in log.splitlines()):
        if (root / name).exists():
            changed[root / name] += int(added) + int(deleted)
    return {path for path, _ in changed.most_common(n)}


def check(commands, jobs=1):
    """What is found, file by file."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        yield from filter(None, pool.map(run, commands))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("check", choices=("alone", "tidy"))
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--every", type=int, default=1,
                        help="a sample: only every so many of all files")
    parser.add_argument("--most-changed", type=int, metavar="N",
                        help="only the N sources that the last ten commits changed most")
    options = parser.parse_intermixed_args()
    files = {path.resolve() for path in options.files} if options.files else None
    if options.most_changed:
        files = most_changed(ROOT, options.most_changed)
    make = {"alone": alone, "tidy": tidy}[options.check]
    commands = make(ROOT, options.build.resolve(), files)[::options.every]
    n_found = 0
    for said in check(commands, options.jobs):
        n_found += 1
        print(said, flush=True)
    print(f"{options.check}: {len(commands)} files compiled, {n_found} to mend")
    return 1 if n_found else 0


if __name__ == "__main__":
    sys.exit(main())
