"""Read the output directory of a run."""

import csv
import json
import pathlib
import xml.etree.ElementTree

from .table import table


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    return table({name: [number(row[i]) for row in rows] for i, name in enumerate(head)})


class Run:
    """The files of an output directory: `summary` is summary.json, `tables` the names of all CSV
    files, and `case` the folder of a load case, empty for a run with one load case."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        with open(self.directory / "summary.json", encoding="utf-8") as file:
            self.summary = json.load(file)
        self.tables = sorted(str(path.relative_to(self.directory))
                             for path in self.directory.rglob("*.csv"))

    def __repr__(self):
        return f"Run({str(self.directory)!r}: {', '.join(self.tables) or 'no tables'})"

    def table(self, name):
        """Return a CSV file, such as "profile.csv", as a table."""
        return read_csv(self.directory / name)

    @property
    def history(self):
        """The table of the design iterations of an optimization."""
        return self.table("history.csv")

    def contact(self, state=-1, case=""):
        """Return the table of the slave nodes of a written state, the last one by default."""
        files = sorted((self.directory / case).glob("contact-[0-9]*.csv"))
        if not files:
            raise FileNotFoundError(f"no contact-*.csv in {self.directory / case}")
        return read_csv(files[state])

    def state(self, state=-1, case="", kind="solution"):
        """Return the data sets of a written state by their names, such as "punch.bottom". The
        kind is "solution" or "contact". The package pyvista reads them."""
        import pyvista

        folder = self.directory / case
        root = xml.etree.ElementTree.parse(folder / f"{kind}.pvd").getroot()
        files = list(dict.fromkeys(part.get("file") for part in root.iter("DataSet")))
        root = xml.etree.ElementTree.parse(folder / files[state]).getroot()
        blocks = {}  # with several ranks a block has a file of each
        for part in root.iter():
            if part.tag in ("Piece", "DataSet") and part.get("name"):
                blocks[part.get("name")] = [pyvista.read(folder / data.get("file"))
                                            for data in part.iter("DataSet")]
        return {name: pyvista.merge(parts) if len(parts) > 1 else parts[0]
                for name, parts in blocks.items()}


def read(directory):
    """Return the Run of an output directory."""
    return Run(directory)
