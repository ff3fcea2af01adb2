#!/usr/bin/env python3
"""Tables of pages get new numbers, and keep their labels and heads."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "contrib" / "lib"))

import page_tables  # noqa: E402


def row(unknowns, *quantities, more=None):
    return {"F-mults": "12", "seconds": "0.1", "quantities": [("", *of) for of in quantities],
            **(more or {}), "unknowns": str(unknowns)}


def rewritten(text, **rows):
    return page_tables.rewritten(pathlib.Path("page.md"), text, rows)


class PageTables(unittest.TestCase):
    def test_all_of_each_quantity(self):
        text = ("before\n<!-- contrib/gallery line -->\n"
                "| unknowns | p0 (exact 5.09) | error | F-mults | seconds |\n|---|---|---|---|---|\n"
                "| 1 | 2 | 3 | 4 | 5 |\nbehind | it\n")
        self.assertEqual(
            rewritten(text, line=[row(80, (5., 4.)), row(90, (4.00004, 4.))]),
            "before\n<!-- contrib/gallery line -->\n"
            "| unknowns | p0 (exact 4) | error | F-mults | seconds |\n|---|---|---|---|---|\n"
            "| 80 | 5 | +25.0 % | 12 | 0.1 |\n| 90 | 4.00004 | +0.001 % | 12 | 0.1 |\n"
            "behind | it\n")

    def test_labels_of_two_scenes_and_quantities_left_out(self):
        text = ("<!-- contrib/gallery a b: label, unknowns, skip, error, value, seconds -->\n"
                "| case | unknowns | error of f | p | s |\n|---|---|---|---|---|\n"
                "| flat | | | | |\n| | | | | |\n")
        quantities = (9., 1.), (2.002, 2.), (7., 7.)
        self.assertEqual(
            rewritten(text, a=[row(5, *quantities)], b=[row(6, *quantities)]).splitlines()[3:],
            ["| flat | 5 | +1.0e-03 | 7 | 0.1 |", "| | 6 | +1.0e-03 | 7 | 0.1 |"])

    def test_what_was_not_run_stays(self):
        text = "<!-- contrib/gallery a b -->\n| x |\n|---|\n| 1 |\n"
        self.assertEqual(rewritten(text, a=[row(5)]), text)

    def test_tables_that_do_not_fit_are_named(self):
        head = "<!-- contrib/gallery a: {} -->\n| x | y |\n|---|---|\n| 1 | 2 |\n"
        for columns, says in (("unknowns", "2 columns"), ("label, size", "must be some of"),
                              ("label, unknowns", "1 labels for 2 rows")):
            with self.assertRaisesRegex(page_tables.PageError, says):
                rewritten(head.format(columns), a=[row(5), row(6)])

    def test_all_markers_are_of_tables_that_fit(self):
        """With the quantities that pages tell of now."""
        for page in page_tables.pages():
            text = page.read_text(encoding="utf-8")
            self.assertEqual(text.count("<!-- contrib/gallery"), len(page_tables.tables_of(page)))
            for match in page_tables.TABLE.finditer(text):
                names, lines = match[2].split(), match[4].splitlines()
                n = (len(page_tables.split(lines[0])) - 3) // 2 if match[3] is None else 5
                more = {key.strip(): "" for key in (match[3] or "").split(",")} \
                    if page.name == "choices.md" else {}
                rows = {name: (len(lines) - 2) // len(names) * [row(5, *n * [(1., 1.)], more=more)]
                        for name in names}
                page_tables.rewritten(page, text, rows)


if __name__ == "__main__":
    unittest.main()
