"""The includes obey the module table of doc/architecture.md."""

import re

from files import CODE, lines, place, text_files

TABLE = "doc/architecture.md"
HEAD = re.compile(r"^\|\s*module\s*\|")
ROW = re.compile(r"^\|\s*`(\w+)`\s*\|[^|]*\|\s*([^|]+?)\s*\|\s*$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def table_rows(root):
    """(line number, module, last column) of the rows of the module table."""
    rows, inside = [], False
    for number, line in lines(root / TABLE):
        inside = line.startswith("|") and (inside or bool(HEAD.match(line)))
        row = ROW.match(line)
        if inside and row:
            rows.append((number, row.group(1), row.group(2)))
    return rows


def read_table(root):
    """({module: modules it may include}, messages about the table itself).

    A row's last column lists modules, or says "nothing", or "all" for every
    row above it."""
    rows, messages = table_rows(root), []
    names = [name for _, name, _ in rows]
    allowed = {}
    for index, (number, name, text) in enumerate(rows):
        listed = set(re.findall(r"`(\w+)`", text))
        if text == "all":
            listed = set(names[:index])
        here = place(root, root / TABLE, number)
        for other in sorted(listed):
            if other not in names:
                messages.append(f"{here}: no module is called '{other}'")
            elif names.index(other) >= index:
                messages.append(f"{here}: '{name}' may include only rows"
                                f" above it, not '{other}'")
        allowed[name] = listed
    if not rows:
        messages.append(f"{TABLE}:1: no module table found")
    return allowed, messages


def module_of(root, path):
    """The module a file belongs to: include/snug/<module>/, source/<module>/."""
    parts = path.relative_to(root).parts
    inside = parts[2:] if parts[0] == "include" else parts[1:]
    return inside[0] if len(inside) > 1 else None


def check_file(root, path, allowed):
    module = module_of(root, path)
    if module not in allowed:
        yield (f"{place(root, path)}: folder '{module}' is no module of {TABLE}")
        return
    for number, line in lines(path):
        include = INCLUDE.match(line)
        if not include:
            continue
        quote, target = include.groups()
        here = place(root, path, number)
        if quote == '"' and "/" in target:
            yield f"{here}: include other folders as <snug/...>, not \"{target}\""
        if not target.startswith("snug/"):
            continue
        used = target.split("/")[1]
        if used not in allowed:
            yield f"{here}: no module is called '{used}'"
        elif used != module and used not in allowed[module]:
            yield f"{here}: module '{module}' may not include '{used}'"


def check(root):
    allowed, messages = read_table(root)
    for path in text_files(root, ("include", "source"), CODE):
        messages += check_file(root, path, allowed)
    return messages
