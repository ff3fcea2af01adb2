#!/usr/bin/env python3
"""Hold the project to its rules: lint.py CHECK [--root DIR] [--program SNUG].

Prints file:line: message for every finding; exit status 1 if there is one."""

import argparse
import pathlib
import sys

import formatting
import layout
import links
import modules
import options
import program
import size
import words

CHECKS = {
    "modules": lambda root, snug: modules.check(root),
    "format": lambda root, snug: formatting.check(root),
    "layout": lambda root, snug: layout.check(root),
    "size": lambda root, snug: size.check(root),
    "words": lambda root, snug: words.check(root),
    "links": lambda root, snug: links.check(root),
    "options": lambda root, snug: options.check(root),
    "scenes": program.check_scenes,
    "parameters": program.check_parameters,
}


def main():
    here = pathlib.Path(__file__).resolve()
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("check", choices=CHECKS)
    parser.add_argument("--root", type=pathlib.Path, default=here.parents[2])
    parser.add_argument("--program", default="build/snug")
    given = parser.parse_args()
    messages = CHECKS[given.check](given.root.resolve(), given.program)
    print("\n".join(messages) or f"{given.check}: nothing to mend")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
