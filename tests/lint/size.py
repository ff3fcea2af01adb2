"""Functions one can read at once, and modules in which one finds one's way."""

import re

from files import CODE, lines, place, text_files
from modules import module_of

MAX_FUNCTION_LINES = 60
MAX_MODULE_SHARE = 0.1
# Shares of a few files mean nothing.
ENOUGH_LINES = 1000
NO_FUNCTION = re.compile(r"^(class|struct|enum|union|namespace)\b")


def functions(numbered):
    """(first line, lines) of the functions at the left margin: as clang-format leaves
    them, they begin and end with a brace in the first column."""
    head, begin = None, None
    for number, line in numbered:
        if line == "{":
            begin = None if head is None or NO_FUNCTION.match(head[1]) else number
        elif line.startswith("}"):
            if begin is not None:
                yield head[0], number - begin - 1
            head = begin = None
        elif line and not line[0].isspace() and not line.startswith(("//", "#", "template <", ":")):
            head = (number, line)


def check_functions(root):
    for path in text_files(root, ("include", "source", "tests"), CODE):
        for number, length in functions(lines(path)):
            if length > MAX_FUNCTION_LINES:
                yield (f"{place(root, path, number)}: a function of {length} lines, more than"
                       f" {MAX_FUNCTION_LINES}")


def check_modules(root):
    sizes = {}
    for path in text_files(root, ("include", "source"), CODE):
        module = module_of(root, path)
        sizes[module] = sizes.get(module, 0) + len(lines(path))
    total = sum(sizes.values())
    for module, size in sorted(sizes.items()):
        if total > ENOUGH_LINES and size > MAX_MODULE_SHARE * total:
            yield (f"source/{module}:1: {size} of {total} lines, more than"
                   f" {MAX_MODULE_SHARE:.0%}: split the module")


def check(root):
    return [*check_functions(root), *check_modules(root)]
