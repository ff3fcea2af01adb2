"""Read parameters.prm, which a run leaves with every entry as it was used."""

import os
import re

import numpy as np

from states import PlotError, existing


class Parameters:
    """This class has the entries of parameters.prm: sections by title, '' for those outside of
    subsections, and in each the values by name."""

    def __init__(self, directory):
        path = existing(os.path.join(directory, "parameters.prm"))
        self.sections, title = {"": {}}, [""]
        with open(path, encoding="utf-8") as file:
            for line in file:
                words = line.strip().split(maxsplit=1)
                if words[:1] == ["subsection"]:
                    title.append(words[1])
                    self.sections.setdefault(words[1], {})
                elif words == ["end"]:
                    title.pop()
                elif words[:1] == ["set"]:
                    name, _, value = words[1].partition("=")
                    self.sections[title[-1]][name.strip()] = value.strip()
        if "Dimension" not in self.sections[""]:
            raise PlotError(f"file '{path}' is damaged")

    def names(self, entry):
        return words_of(self.sections[""].get(entry, ""))

    def section(self, title):
        return self.sections.get(title, {})

    def case_name(self, name):
        """Return the name of a load case, that of the only one for ''."""
        cases = self.names("Load cases")
        return name or (cases[0] if len(cases) == 1 else "")

    def case(self, name):
        """Return the entries of a load case, of the only one for ''."""
        return self.section(f"Load case {self.case_name(name)}")

    def position(self, case, name):
        """Return the motion of a body or an obstacle in a load case as a 4 x 4 matrix."""
        positions = dict(part.split(":", 1) for part in
                         self.case(case).get("Position", "").split(";") if ":" in part)
        positions = {of.strip(): motions for of, motions in positions.items()}
        return motion(positions.get(name, ""))


def words_of(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def numbers_of(text):
    """Return three coordinates, of flat models with a zero."""
    values = [float(word) for word in text.replace(",", " ").split()]
    return np.array(values + (3 - len(values)) * [0.])


def items_of(text):
    """Return the (key, value) of a list 'key: value, ...', whose values may have commas within
    brackets."""
    return [tuple(part.strip() for part in item.split(":", 1))
            for item in re.split(r",(?![^()]*\))", text) if ":" in item]


def motion(text):
    """Return the matrix of 'rotate z 12 about 100 0, shift 0 1'."""
    result = np.eye(4)
    for step in words_of(text):
        kind, *words = step.split()
        matrix = np.eye(4)
        if kind == "shift":
            matrix[:3, 3] = numbers_of(" ".join(words))
        else:
            a, angle = "xyz".index(words[0]), np.radians(float(words[1]))
            b, c = (a + 1) % 3, (a + 2) % 3
            matrix[[b, c], [b, c]] = np.cos(angle)
            matrix[c, b], matrix[b, c] = np.sin(angle), -np.sin(angle)
            about = numbers_of(" ".join(words[3:]))
            matrix[:3, 3] = about - matrix[:3, :3] @ about
        result = matrix @ result
    return result
