"""No marks of unfinished work, no control characters, and plain words: doc comments begin with
a verb or a noun, nouns agree with the number 1, cells of tables are short."""

import re
import unicodedata

from files import CODE, lines, place, text_files, top_files

# Split so that this file does not find itself.
MARK = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b")
FRAGMENT = re.compile(r"\s*(?:///|/\*\*|\*)<?\s*(Of|Those|That|What|Whether|None|As)\b")
COMMENT = re.compile(r"\s*(?:///|\*|/\*\*.)")  # not a first line /** without text
ONE_OF_MANY = re.compile(r"(?<![\w.,])1 (bodies|cells|evaluations|F-mults|faces|iterations|meshes|"
                         r"nodes|processes|ranks|records|responses|subdomains|unknowns|variables)\b")
MAX_CELL = 300


def check_comments(root, path):
    """Doc comments that begin with a fragment instead of a verb or a noun."""
    inside = False
    for number, line in lines(path):
        first = FRAGMENT.match(line)
        if first and not inside:
            yield (f"{place(root, path, number)}: a doc comment begins with"
                   f" '{first.group(1)}'; begin with a verb or a noun")
        inside = bool(COMMENT.match(line))


def check_cells(root, path):
    """Cells of tables that are too long to read."""
    for number, line in lines(path):
        cells = line.replace(r"\|", " ").split("|")[1:-1] if line.startswith("|") else []
        for length in (len(cell.strip()) for cell in cells):
            if length > MAX_CELL:
                yield (f"{place(root, path, number)}: a cell of {length} characters, more than"
                       f" {MAX_CELL}; use a list below the table")


def check_line(root, path, number, line):
    for character in sorted(set(line)):
        # Control characters, and those without a width, which no reader sees.
        if unicodedata.category(character) in ("Cc", "Cf"):
            yield f"{place(root, path, number)}: the control character U+{ord(character):04X}"
    if MARK.search(line):
        yield f"{place(root, path, number)}: finish it or open an issue: {line.strip()}"
    for noun in ONE_OF_MANY.findall(line):
        yield f"{place(root, path, number)}: '1 {noun}': the noun must agree with its number"


def check(root):
    messages = []
    for path in [*text_files(root), *top_files(root)]:
        for number, line in lines(path):
            messages += check_line(root, path, number, line)
        if path.suffix == ".md":
            messages += check_cells(root, path)
    for path in text_files(root, ("include", "source", "tests"), CODE):
        messages += check_comments(root, path)
    return messages
