"""Tables of pages that a command renews: their rows stand below a comment

    <!-- contrib/gallery NAME [NAME]...: COLUMN, COLUMN, ... -->

with the rows of the scenes NAME one after the other. COLUMN is 'label', which stays as it is,
'unknowns', 'F-mults', 'seconds', or tells the value or the error of a quantity: 'value',
'error', 'error %'. An error ends a quantity, and so does the value of the next one; 'skip'
leaves a quantity out. Tables of other numbers name their columns. Without columns the table has
all quantities. The head stays as well, but for numbers in brackets that a known answer changes:
'(exact 20.1)', '(Hertz 20.1)'."""

import re

from runs import ROOT

TABLE = re.compile(r"(<!-- contrib/gallery ([\w -]+?)(?::([^>]*?))? -->\n)((?:\|.*\n)+)")
WORDS = ("label", "skip", "value", "error", "error %")


class PageError(Exception):
    """This class is one line that names the page and what is wrong."""


def pages():
    """Return the pages with such tables."""
    candidates = [*sorted((ROOT / "doc/gallery").glob("*.md")), ROOT / "doc/choices.md"]
    return [page for page in candidates if TABLE.search(page.read_text(encoding="utf-8"))]


def tables_of(page):
    """Return the names of the scenes of each table of a page."""
    return [match[2].split() for match in TABLE.finditer(page.read_text(encoding="utf-8"))]


def percent(error):
    """Return an error in percent with two digits, and a small one as it is."""
    if abs(error) < 5e-6:
        return f"{error:+.1e}"
    digits = 1 if abs(error) >= 5e-3 else 2 if abs(error) >= 5e-5 else 3
    return f"{100. * error:+.{digits}f} %"


def with_places(columns):
    """Return [(column, index of its quantity)], without what is skipped."""
    result, place, last = [], 0, None
    for column in columns:
        place += column == last == "value"
        if column != "skip":
            result.append((column, place))
        place += column.startswith("error") or column == "skip"
        last = column
    return result


def cell(row, column, place, label):
    """Return the text of a cell; label: what stands in the old one."""
    if column == "label":
        return label
    if column in row:
        return row[column]
    _, value, known = row["quantities"][place]
    error = value / known - 1.
    return {"value": f"{value:.6g}", "error": f"{error:+.1e}", "error %": percent(error)}[column]


def head(old, row, column, place):
    """Return the old head of a column, with the known answer of a row in its brackets."""
    def renewed(match):
        digits = max(1, len(re.sub(r"e.*|[-+.]", "", match[2]).lstrip("0")))
        return f"({match[1]} {row['quantities'][place][2]:.{digits}g}"
    return re.sub(r"\((exact|Hertz) (-?[\d.e+-]+)", renewed, old) if column == "value" else old


def split(line):
    """Return the cells of a line."""
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def joined(cells):
    """Return the line of cells."""
    return f"| {' | '.join(cells)} |".replace("|  |", "| |") + "\n"


def renewed_table(where, text, columns, rows):
    """Return the lines of a table with new rows. A row is {unknowns, F-mults, seconds,
    quantities: [(name, value, known answer)]}."""
    lines = text.splitlines()
    heads, old = split(lines[0]), [split(line) for line in lines[2:]]
    known = sorted({*WORDS, *rows[0]} - {"quantities"})
    if any(column not in known for column in columns):
        raise PageError(f"{where}: the columns must be some of {', '.join(known)}")
    columns = with_places(columns)
    if len(heads) != len(columns):
        raise PageError(f"{where}: the head has {len(heads)} columns, the comment {len(columns)}")
    labelled = any(column == "label" for column, _ in columns)
    if labelled and len(old) != len(rows):
        raise PageError(f"{where}: {len(old)} labels for {len(rows)} rows")
    labels = old if labelled else [[""] * len(columns)] * len(rows)
    return "".join([
        joined(head(of, rows[0], *column) for of, column in zip(heads, columns)), lines[1] + "\n",
        *(joined(cell(row, *column, label) for column, label in zip(columns, of_row))
          for row, of_row in zip(rows, labels))])


def rewritten(page, text, rows):
    """Return the text of a page with the tables whose scenes are all in rows: {name: [row]}."""
    def table(match):
        names = match[2].split()
        if any(name not in rows for name in names):
            return match[0]
        new = [row for name in names for row in rows[name]]
        columns = (["unknowns", *len(new[0]["quantities"]) * ["value", "error %"], "F-mults",
                    "seconds"] if match[3] is None else
                   [word.strip() for word in match[3].split(",")])
        return match[1] + renewed_table(f"{page.name}, table of {match[2]}", match[4], columns, new)
    return TABLE.sub(table, text)


def write(rows):
    """Put new rows into all pages that have a table of them; return the pages changed."""
    changed = []
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = rewritten(page, text, rows)
        if new != text:
            page.write_text(new, encoding="utf-8")
            changed.append(page)
    return changed
