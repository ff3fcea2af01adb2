"""The files of the project and how to name a place in them."""

import pathlib

# Folders whose text is ours; anything else (build trees, output) is not.
FOLDERS = (".ci", ".github", "contrib", "doc", "include", "prm", "source", "tests")
TOP = (".clang-format", ".clang-tidy", ".editorconfig", "CHANGELOG.md", "CITATION.cff",
       "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md", "Containerfile", "README.md")
CODE = (".h", ".cc")


def text_files(root, folders=FOLDERS, suffixes=None):
    """Paths below root/folders, sorted; with suffixes only those."""
    for folder in folders:
        for path in sorted(pathlib.Path(root, folder).rglob("*")):
            if not path.is_file() or "__pycache__" in path.parts:
                continue
            if suffixes is None or path.suffix in suffixes:
                yield path


def top_files(root):
    """Our text files of the main folder; LICENSE is text of others."""
    return [root / name for name in TOP if (root / name).is_file()]


def lines(path):
    """(number, line) of a text file; none of a binary one. Only a line feed ends a line, so that
    other control characters stay in it."""
    try:
        text = path.read_bytes().decode("utf-8")
    except UnicodeDecodeError:
        return []
    text = text.removesuffix("\n")
    return list(enumerate(text.split("\n"), 1)) if text else []


def place(root, path, line=1):
    """path:line as compilers print it, relative to root."""
    return f"{pathlib.Path(path).relative_to(root)}:{line}"
