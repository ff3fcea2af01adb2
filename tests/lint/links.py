"""Links, pictures and the names of files in pages and in CMake files lead to files that exist, and
pages on an interface name each of its functions.

A page names files by their path, and in `code` also by module/file, with or without the suffix, or
by the name of a source alone. The changelog names files of the past."""

import re

from files import CODE, FOLDERS, lines, place, text_files, top_files

LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)")
ELSEWHERE = re.compile(r"^(https?:|mailto:|#)")
CODE_SPAN = re.compile(r"`([^`]*)`")
HEADER = re.compile(r"<(snug/[\w/]+\.h)>")
FOLDER = "|".join(re.escape(folder) for folder in FOLDERS)
# A path from the main folder, which no longer path, address or variable precedes.
PATH = re.compile(rf"(?<![\w./}}>-])((?:{FOLDER})/[\w./+-]*\w)(?![\w/]*[*<{{$])")
# In CMake files: a path from the file's own folder.
ARGUMENT = re.compile(r"(?<![\w./}<>:-])((?:\.\./[\w./+-]*\w|[\w./+-]*\w\.(?:cc|h|in|py)))"
                      r"(?![\w./{$*])")
PLACEHOLDER = re.compile(r"\b(BODY|DECK|FILE|NAME)\b")
# The files that doc/add-a-response.md adds.
ADDED = re.compile(r"/displaced_volume\.cc$")
# Pages that tell when to override each virtual function of a header.
INTERFACES = {"doc/add-a-response.md": "include/snug/response/response.h"}
VIRTUAL = re.compile(r"\bvirtual [^;({~]*\b(\w+)\(")


def check_links(root, path, number, line):
    for target in LINK.findall(CODE_SPAN.sub("", line)):
        file = path.parent / target.split("#")[0]
        if not ELSEWHERE.match(target) and not file.exists():
            yield f"{place(root, path, number)}: no file '{target}'"


def short_names(root, line):
    """(name, whether it exists) of the files that code in a line names without their folder."""
    for name in " ".join(CODE_SPAN.findall(line)).split():
        module = name.split("/")[0]
        if re.fullmatch(r"\w+(/\w+)+(\.\w+)?", name) and (root / "source" / module).is_dir():
            paths = [root / folder / name for folder in ("include/snug", "source", "tests/unit")]
            yield name, any(path.exists() or any(path.parent.glob(path.name + ".*"))
                            for path in paths)
        elif re.fullmatch(r"\w+\.(cc|h|py)", name):
            yield name, any(path.name == name for path in text_files(root, suffixes=(*CODE, ".py")))


def check_names(root, path, number, line):
    line = line.replace("${PROJECT_SOURCE_DIR}/", "")
    paths = [*PATH.findall(line), *("include/" + name for name in HEADER.findall(line))]
    named = [(name, (root / name).exists()) for name in paths]
    if path.suffix == ".md":
        named += short_names(root, line)
    else:
        arguments = ARGUMENT.findall(line.split("#")[0])
        named += [(name, (path.parent / name).exists()) for name in arguments if name not in paths]
    for name, exists in named:
        if not (exists or PLACEHOLDER.search(name) or ADDED.search(name)):
            yield f"{place(root, path, number)}: no file '{name}'"


def check_file(root, path):
    in_code = False
    for number, line in lines(path):
        if line.lstrip().startswith("```"):
            in_code = not in_code
        if path.suffix == ".md" and not in_code:
            yield from check_links(root, path, number, line)
        if path.name != "CHANGELOG.md":
            yield from check_names(root, path, number, line)


def check_interfaces(root):
    for page, header in INTERFACES.items():
        if not (root / header).is_file():
            continue
        first_cells = {line.split("|")[1].strip() for _, line in lines(root / page) if "|" in line}
        for function in VIRTUAL.findall((root / header).read_text(encoding="utf-8")):
            if f"`{function}`" not in first_cells:
                yield f"{page}:1: the tables lack `{function}` of {header}"


def check(root):
    paths = [path for path in [*top_files(root), *text_files(root)]
             if path.suffix in (".cmake", ".md") or path.name == "CMakeLists.txt"]
    messages = [message for path in paths for message in check_file(root, path)]
    return [*dict.fromkeys(messages), *check_interfaces(root)]
