"""Tables of pages that a command remakes: their rows stand below a comment

    <!-- contrib/gallery NAME [NAME]...: COLUMN, COLUMN, ... -->

with the rows of the scenes NAME one after the other. COLUMN is 'label', which stays as
it is, or 'unknowns', 'value', 'error', 'error %', 'F-mults' or 'seconds'. An error ends
what is told of a quantity, and so does the value of the next one; 'skip' leaves a quantity
out. Tables of other numbers name their columns. Without columns the table has all of each
quantity. The head stays as well, but for numbers in brackets that
a known answer changes: '(exact 20.1)', '(Hertz 20.1)'."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = re.compile(r"(<!-- contrib/gallery ([\w -]+?)(?::([^>]*?))? -->\n)((?:\|.*\n)+)")
WORDS = ("label", "skip", "unknowns", "value", "error", "error %", "F-mults", "seconds")


class PageError(Exception):
    """One line that names the page and what is wrong."""


def pages():
    """The pages with such tables."""
    candidates = [*sorted((ROOT / "doc/gallery").glob("*.md")), ROOT / "doc/choices.md"]
    return [page for page in candidates if TABLE.search(page.read_text(encoding="utf-8"))]


def tables_of(page):
    """[names of scenes] of each table of a page."""
    return [match[2].split() for match in TABLE.finditer(page.read_text(encoding="utf-8"))]


def columns_of(text, n_quantities):
    """The columns of a marker; those of all quantities if it names none."""
    if text is None:
        return ["unknowns", *n_quantities * ["value", "error %"], "F-mults", "seconds"]
    return [word.strip() for word in text.split(",")]


def number(value, digits):
    """Without an exponent that a page does not need."""
    return f"{value:.{digits}g}"


def percent(error):
    """Two digits, and small ones as they are."""
    if abs(error) < 5e-6:
        return f"{error:+.1e}"
    digits = 1 if abs(error) >= 5e-3 else 2 if abs(error) >= 5e-5 else 3
    return f"{100. * error:+.{digits}f} %"


def plan(columns):
    """[(column, index of its quantity)], without what is skipped."""
    result, place, last = [], 0, None
    for column in columns:
        place += column == "value" and last == "value"
        if column != "skip":
            result.append((column, place))
        place += column.startswith("error") or column == "skip"
        last = column
    return result


def cells(row, planned, labels):
    """The cells of one row. row: {unknowns, F-mults, seconds, quantities: [(name, value,
    known answer)]}; labels: what stands in the old row."""
    result = []
    for index, (column, place) in enumerate(planned):
        if column == "label":
            result.append(labels[index])
        elif column in row:
            result.append(row[column])
        else:
            _, value, known = row["quantities"][place]
            error = value / known - 1.
            result.append(number(value, 6) if column == "value" else
                          percent(error) if column == "error %" else f"{error:+.1e}")
    return result


def heads(old, row, planned):
    """The old head, with the known answers of a row in its brackets."""
    result = list(old)
    for index, (column, place) in enumerate(planned):
        if column == "value":
            known = row["quantities"][place][2]
            result[index] = re.sub(r"\((exact|Hertz) (-?[\d.e+-]+)",
                                   lambda m, k=known: f"({m[1]} {number(k, digits_of(m[2]))}",
                                   old[index])
    return result


def line_of(cells_of_line):
    return f"| {' | '.join(cells_of_line)} |".replace("|  |", "| |") + "\n"


def digits_of(text):
    """Significant digits of a number as it is written."""
    return max(1, len(re.sub(r"e.*|[-+.]", "", text).lstrip("0")))


def split(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def rewritten(page, text, rows):
    """The text of a page with the tables whose scenes are all in rows: {name: [row]}."""
    def table(match):
        names = match[2].split()
        if any(name not in rows for name in names):
            return match[0]
        lines = match[4].splitlines()
        new = [row for name in names for row in rows[name]]
        columns = columns_of(match[3], len(new[0]["quantities"]))
        head, old = split(lines[0]), [split(line) for line in lines[2:]]
        where = f"{page.name}, table of {match[2]}"
        known = sorted({*WORDS, *new[0]} - {"quantities"})
        if any(column not in known for column in columns):
            raise PageError(f"{where}: the columns must be some of {', '.join(known)}")
        planned = plan(columns)
        if len(head) != len(planned):
            raise PageError(f"{where}: the head has {len(head)} columns, the comment "
                            f"{len(planned)}")
        if "label" in columns and len(old) != len(new):
            raise PageError(f"{where}: {len(old)} labels for {len(new)} rows")
        body = [cells(row, planned, old[k] if k < len(old) else [])
                for k, row in enumerate(new)]
        return "".join([match[1], line_of(heads(head, new[0], planned)), lines[1] + "\n",
                        *map(line_of, body)])
    return TABLE.sub(table, text)


def write(rows):
    """Put new rows into all pages that have a table of them; returns the pages changed."""
    changed = []
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = rewritten(page, text, rows)
        if new != text:
            page.write_text(new, encoding="utf-8")
            changed.append(page)
    return changed
