#!/usr/bin/env python3
"""Hold the project to its rules: lint.py CHECK [--root DIR] [--program SNUG] [--base COMMIT].

Prints file:line: message for every finding; exit status 1 if there is one."""

import argparse
import pathlib
import sys

import commits
import formatting
import layout
import links
import modules
import options
import program
import shell
import size
import words

CHECKS = {
    "modules": lambda root, given: modules.check(root),
    "format": lambda root, given: formatting.check(root),
    "layout": lambda root, given: layout.check(root),
    "size": lambda root, given: size.check(root),
    "words": lambda root, given: words.check(root),
    "commits": lambda root, given: commits.check(root, given.base),
    "links": lambda root, given: links.check(root),
    "shell": lambda root, given: shell.check(root),
    "options": lambda root, given: options.check(root),
    "scenes": lambda root, given: program.check_scenes(root, given.program),
    "parameters": lambda root, given: program.check_parameters(root, given.program),
}


def main():
    here = pathlib.Path(__file__).resolve()
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("check", choices=CHECKS)
    parser.add_argument("--root", type=pathlib.Path, default=here.parents[2])
    parser.add_argument("--program", default="build/snug")
    parser.add_argument("--base", default="",
                        help="check the titles of the commits since this one, not of HEAD alone")
    given = parser.parse_args()
    messages = CHECKS[given.check](given.root.resolve(), given)
    print("\n".join(messages) or f"{given.check}: nothing to mend")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
