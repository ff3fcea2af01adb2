"""The files of the project and how to name a place in them."""

import pathlib

# Folders whose text is ours; anything else (build trees, output) is not.
FOLDERS = (".ci", "contrib", "doc", "include", "prm", "source", "tests")
CODE = (".h", ".cc")


def text_files(root, folders=FOLDERS, suffixes=None):
    """Paths below root/folders, sorted; with suffixes only those."""
    for folder in folders:
        for path in sorted(pathlib.Path(root, folder).rglob("*")):
            if not path.is_file() or "__pycache__" in path.parts:
                continue
            if suffixes is None or path.suffix in suffixes:
                yield path


def lines(path):
    """(number, line) of a text file; none of a binary one."""
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return []
    return list(enumerate(text.splitlines(), 1))


def place(root, path, line=1):
    """path:line as compilers print it, relative to root."""
    return f"{pathlib.Path(path).relative_to(root)}:{line}"
