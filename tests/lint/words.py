"""No marks of unfinished work in our text."""

import re

from files import lines, place, text_files

# Split so that this file does not find itself.
MARK = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b")
TOP = ("CMakeLists.txt", "README.md", "CHANGELOG.md", "CITATION.cff")


def check(root):
    paths = list(text_files(root))
    paths += [root / name for name in TOP if (root / name).is_file()]
    return [f"{place(root, path, number)}: finish it or open an issue:"
            f" {line.strip()}"
            for path in paths
            for number, line in lines(path) if MARK.search(line)]
