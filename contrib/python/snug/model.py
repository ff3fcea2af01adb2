"""A model, whose designs are evaluated by a process of the program."""

import concurrent.futures
import json
import html
import os
import pathlib
import queue
import tempfile

import numpy as np

from .errors import DesignFailed, RequestError
from .process import Process, find_program
from .table import table, vectors

ROUND_OFF = 1e-9  # of the width of the bounds: optimizers leave bounds by round-off


def text_of(value):
    """Return the value of an entry as in a parameter file."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple, np.ndarray)):
        return ", ".join(map(text_of, value))
    return repr(float(value)) if isinstance(value, np.floating) else str(value)


def progress(rows, n):
    """Return the rows with a bar of their progress on terminals and in notebooks, if tqdm is
    installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return rows
    return tqdm(rows, total=n, unit="design", disable=None)


class Result:
    """The answer to an evaluation; `answer` is its JSON.

    values       number of each response
    gradients    derivatives of the wanted responses, arrays of the size of the design
    objective    value of the objective of the model, objective_gradient with gradients=True
    constraints  value of each constraint of the model
    errors       estimated discretization errors of responses, with errors=True
    certificate  the largest relative error of the solutions, measured independently of the solver
    drift        distance from the last contact search in sizes of faces
    work         applications of F and factorizations that the answer took"""

    def __init__(self, answer):
        self.answer, self.x = answer, np.array(answer["x"], float)
        self.values, self.work, self.drift = answer["values"], answer["work"], answer["drift"]
        self.gradients = {name: np.array(row, float)
                          for name, row in answer.get("gradients", {}).items()}
        self.objective = answer["objective"]["value"]
        self.objective_gradient = answer["objective"].get("gradient")
        self.constraints = {part["name"]: part["value"] for part in answer["constraints"]}
        self.load_cases, self.errors = answer["load_cases"], answer.get("errors", {})
        self.certificate = max(part["certificate"] for part in self.load_cases)

    def __getitem__(self, name):
        return self.values[name]

    def __repr__(self):
        values = ", ".join(f"{name}={value:.6g}" if value is not None else f"{name}=None"
                           for name, value in self.values.items())
        return f"Result({values}, certificate={self.certificate:.1e}, drift={self.drift:.2g})"

    def _repr_html_(self):
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{'none' if value is None else f'{value:.6g}'}</td>"
            + (f"<td>{np.linalg.norm(self.gradients[name]):.3g}</td>" if self.gradients else "")
            + "</tr>" for name, value in self.values.items() if not self.gradients
            or name in self.gradients)
        head = "<th>norm of the gradient</th>" if self.gradients else ""
        notes = [f"relative error {self.certificate:.1e}", f"drift {self.drift:.2g} faces",
                 *(part["text"] for part in self.answer.get("warnings", []))]
        return (f"<table><tr><th>response</th><th>value</th>{head}</tr>{rows}</table>"
                f"<p>{html.escape('; '.join(notes))}</p>")

    def contact(self, case=0):
        """Return the table of the slave nodes of a load case, given by its number or name."""
        if "contact" not in self.answer:
            raise RequestError("contact tables require evaluate(.., contact=True)")
        name = case if isinstance(case, str) else self.load_cases[case]["name"]
        parts = [part for part in self.answer["contact"] if part["load_case"] == name]
        if not parts:
            raise RequestError(f"there is no contact table of a load case '{name}'")
        columns = {key: sum((part[key] for part in parts), [])
                   for key in ("pressure", "gap", "force", "area", "status")}
        pairs = sum(([part["pair"]] * len(part["area"]) for part in parts), [])
        position, normal = (sum((part[key] for part in parts), []) for key in ("position", "normal"))
        return table({"pair": pairs, **vectors("", position), **vectors("normal", normal),
                      **columns})


class Model:
    """A parameter file in a process of its own, which keeps meshes and factors.

    file     the parameter file, or a deck
    set      entries and their values, such as {"Contact/Friction coefficient": 0.1}
    ranks    number of MPI processes
    program  path of the program; without it the variable SNUG, then snug on the PATH
    timeout  seconds after which a request without an answer ends the process (Died)"""

    def __init__(self, file, set=None, ranks=1, program=None, timeout=None):
        self.file, self.last, self.folder = file, None, None
        self.arguments = {"ranks": ranks, "program": program, "timeout": timeout}
        self.entries = dict(set or {})
        self.changes = []  # requests that a copy of the model repeats
        command = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        command += [find_program(program), "--serve", os.fspath(file)]
        for entry, value in self.entries.items():
            command += ["--set", f"{entry}={text_of(value)}"]
        self.process = Process(command, timeout)
        self.describe()

    @classmethod
    def from_dict(cls, scene, **arguments):
        """Return the model of {"Task": "state", "Body upper": {"Box cells": [3, 2]}, ..}, a model
        in JSON, whose numbers and lists may be those of numpy."""
        folder = tempfile.TemporaryDirectory(prefix="snug-")
        file = pathlib.Path(folder.name, "model.json")
        file.write_text(json.dumps(scene, default=lambda value: value.tolist()), encoding="utf-8")
        model = cls(file, **arguments)
        model.folder = folder
        return model

    def describe(self):
        about = self.about = self.process.call("describe")
        self.variables = [part["name"] for part in about["variables"]]
        self.responses = [part["name"] for part in about["responses"]]
        self.limits, self.load_cases = about["limits"], about["load_cases"]
        self.lower, self.upper, self.start, self.scale = (
            np.array([part[key] for part in about["variables"]], float)
            for key in ("lower", "upper", "start", "scale"))

    def __repr__(self):
        names = [f"{part['name']} [{part['unit']}]" if part.get("unit") else part["name"]
                 for part in self.about["responses"]]
        return (f"Model({os.fspath(self.file)!r}: {self.about.get('unknowns', 0):,} unknowns, "
                f"{len(self.variables)} design variables, responses {', '.join(names)})")

    def design(self, x):
        """Return x as a list, clipped into the bounds where it leaves them by round-off."""
        x = np.asarray(x, float)
        if x.shape != self.lower.shape:
            raise RequestError(f"the design has the shape {x.shape}, but there are "
                               f"{len(self.lower)} design variables")
        if not np.isfinite(x).all():
            raise RequestError("the design must be finite")
        inside = np.clip(x, self.lower, self.upper)
        is_near = np.abs(x - inside) <= ROUND_OFF * (self.upper - self.lower)
        return np.where(is_near, inside, x).tolist()

    def evaluate(self, x=None, gradients=False, start="cold", contact=False,
                 errors=False):
        """Return the Result of a design, the start of the model without x. `gradients` is True
        for all responses, or a list of their names. With start="cold" equal requests have equal
        bits; "warm" begins with the forces of earlier designs, as a search does. `errors` asks for
        the estimated discretization errors."""
        keys = {"x": self.design(self.start if x is None else x), "start": start,
                "gradients": gradients if isinstance(gradients, bool) else list(gradients),
                "contact": contact, "errors": errors}
        if self.last is None or self.last[0] != keys:
            self.last = keys, Result(self.process.call("evaluate", **keys))
        return self.last[1]

    def sample(self, X, processes=1, **keys):
        """Return a table of the designs in the rows of X, their responses, and the column
        `failure`, which is empty or a message. With several processes the numbers are the same,
        because each evaluation starts without a history. With tqdm a bar shows the progress."""
        X = np.atleast_2d(np.asarray(X, float))
        others = [self.copy() for _ in range(min(processes, len(X)) - 1)]
        free = queue.SimpleQueue()
        for model in [self, *others]:
            free.put(model)

        def row(x):
            model = free.get()
            try:
                return {**model.evaluate(x, **keys).values, "failure": ""}
            except DesignFailed as error:
                return {"failure": str(error)}
            finally:
                free.put(model)

        try:
            with concurrent.futures.ThreadPoolExecutor(1 + len(others)) as pool:
                rows = list(progress(pool.map(row, X), len(X)))
        finally:
            for model in others:
                model.close()
        columns = {name: [np.nan if part.get(name) is None else part[name] for part in rows]
                   for name in self.responses}
        return table({**dict(zip(self.variables, X.T)), **columns,
                      "failure": [part["failure"] for part in rows]})

    def copy(self):
        """Return a model of another process with the same entries and contact search."""
        model = Model(self.file, self.entries, **self.arguments)
        for do, keys in self.changes:
            model.change(do, **keys)
        return model

    def change(self, do, **keys):
        self.last = None
        answer = self.process.call(do, **keys)
        self.changes.append((do, keys))
        return answer

    def set(self, entries):
        """Change entries of the model; if that fails, the model stays as it was."""
        self.change("set", entries={name: text_of(value) for name, value in entries.items()})
        self.describe()

    def pair(self, x):
        """Search the contacts of a design anew."""
        self.change("pair", x=self.design(x))

    def write(self, x=None):
        """Write the files of a design to the output directory, and return their paths."""
        answer = self.process.call("write", x=self.design(self.start if x is None else x))
        return [pathlib.Path(answer["directory"], name) for name in answer["files"]]

    def close(self):
        self.process.close()
        if self.folder:
            self.folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()
