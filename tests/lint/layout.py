"""File length, header guards, assertions, and where the deal.II version is asked for."""

import re

from files import CODE, lines, place, text_files

MAX_LINES = 400
COMPATIBILITY = "include/snug/base/deal_ii_compat.h"
VERSION = re.compile(r"^\s*#\s*(if|ifdef|ifndef|elif)\b.*DEAL_II_VERSION")
ASSERTION = re.compile(r"\b(?:Assert(?:Throw|Dimension|IndexRange|IsFinite)?|assert)\s*\(")
DIRECTIVE = re.compile(r"^\s*#\s*(\w+)\s*(.*?)\s*$")


def guard_name(root, path):
    """include/snug/feti/csr_matrix.h -> snug_feti_csr_matrix_h"""
    parts = path.relative_to(root / "include").with_suffix("").parts
    return "_".join(parts + ("h",))


def check_guard(root, path):
    wanted = guard_name(root, path)
    directives = [(number, *DIRECTIVE.match(line).groups())
                  for number, line in lines(path) if DIRECTIVE.match(line)]
    expected = ("ifndef", "define")
    for index, name in enumerate(expected):
        number, *found = directives[index] if index < len(directives) else (1,)
        if found != [name, wanted]:
            yield (f"{place(root, path, number)}: header guard is not"
                   f" '#{name} {wanted}'")
            return
    if directives[-1][1] != "endif":
        yield f"{place(root, path, directives[-1][0])}: no #endif at the end"


def check(root):
    messages = []
    suffixes = CODE + (".py", ".cmake")
    for path in text_files(root, ("contrib", "include", "source", "tests"),
                           suffixes):
        numbered = lines(path)
        if len(numbered) > MAX_LINES:
            messages.append(f"{place(root, path, len(numbered))}: longer than"
                            f" {MAX_LINES} lines")
        if path != root / COMPATIBILITY and path.suffix in CODE:
            messages += [f"{place(root, path, number)}: ask for the deal.II"
                         f" version only in {COMPATIBILITY}"
                         for number, line in numbered if VERSION.match(line)]
        if path.suffix in CODE and root / "tests" not in path.parents:
            messages += [f"{place(root, path, number)}: use the assertions of"
                         " snug/base/assertions.h, which hold in every build"
                         for number, line in numbered if ASSERTION.search(line)]
        if path.suffix == ".h" and root / "include" in path.parents:
            messages += check_guard(root, path)
    return messages
