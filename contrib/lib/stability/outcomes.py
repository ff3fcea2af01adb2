"""Rows of the suite: what each is to end with, and what it ends with."""

import collections
import math
import pathlib
import re
import sys
import tempfile
import time

from runs import built, execute, section

from cases import error
from many import solve_many

SNUG_RANDOM = built("SNUG_RANDOM", "tests/random/random.problems")

# asked: the figures of a Result that are known; where none is, energies on all numbers of
# ranks are compared.
Solved = collections.namedtuple("Solved", "asked", defaults=[None])
# words: part of the line that says why.
Refused = collections.namedtuple("Refused", "status words")
# As rounding has it, which differs with the ranks; of rows that have dense or asked.
SolvedOrRefused = collections.namedtuple("SolvedOrRefused", "status words asked",
                                         defaults=[None])

# Entries of the solver.
METHODS = {"active set": {},
           "SMALSE-M": {"Method": "SMALSE-M"},
           "lumped": {"Preconditioner": "lumped"},
           "no preconditioner": {"Preconditioner": "none"},
           "SMALSE-M, lumped": {"Method": "SMALSE-M", "Preconditioner": "lumped"},
           "SMALSE-M, no preconditioner": {"Method": "SMALSE-M", "Preconditioner": "none"},
           "scaled by multiplicity": {"Scaling": "multiplicity"},
           "MUMPS": {"Factorization": "MUMPS"}}
ALL = tuple(METHODS)
SOLVERS = ALL[:2]
ONE = ALL[:1]

# name: what is hard about it. dense: compared with dense algebra too, on one rank. mesh: makes
# the bytes of mesh.msh. quick: among those of the tests.
Row = collections.namedtuple("Row", "name text end methods dense mesh quick",
                             defaults=[Solved(), SOLVERS, False, None, False])
# certificate: the largest part of it.
Outcome = collections.namedtuple("Outcome", "text certificate f_mults energy",
                                 defaults=[None, None, None])


def expected(row):
    """Return the expected end of a row in words."""
    if isinstance(row.end, Refused):
        return f"exit {row.end.status}: {row.end.words}"
    if isinstance(row.end, SolvedOrRefused):
        return f"solved, or exit {row.end.status}: {row.end.words}"
    return "solved, as dense algebra says" if row.dense else "solved"


def of_method(row, method):
    """Return the text of a row with the entries of a method."""
    return row.text + section("Solver", METHODS[method])


def states_of(result):
    """Return the states of all load cases."""
    return [case["state"] for case in result.summary.get("load_cases", [])] or [result.state]


def refused(end, status, message):
    """Return the Outcome of a run that must be refused."""
    if status == end.status and end.words in message:
        return Outcome("refused")
    said = "solved" if status == 0 else f"exit {status}, {message or 'no line'}"
    return Outcome(f"fails: {said}")


def outcome(row, run):
    """Return the Outcome of a run; its text begins with "fails" if it is not as expected."""
    status, message, result, *_ = run
    if isinstance(row.end, Refused) or isinstance(row.end, SolvedOrRefused) and not result:
        return refused(row.end, status, message)
    if not result:
        return Outcome(f"fails: exit {status}, {message or 'no line'}")
    states = states_of(result)
    found = Outcome("solved", max(max(state["certificate"].values()) for state in states),
                    sum(state["f_mults"] for state in states), result.state["energy"])
    wrong = [f"{figure.name} {figure.found:.6g} instead of {figure.right:.6g}"
             for figure in (row.end.asked(result) if row.end.asked else [])
             if not error(figure) <= figure.bound]
    return found._replace(text="fails: " + "; ".join(wrong)) if wrong else found


def unlike_dense(text):
    """Return what tests/random says of a scene, where it is not what dense algebra finds."""
    with tempfile.TemporaryDirectory() as directory:
        path = pathlib.Path(directory) / "scene.prm"
        path.write_text(text)
        _, said, errors, *_ = execute([SNUG_RANDOM, str(path)])
        said += errors
    match = re.search(r"scene\.prm: (.*); errors", said)
    return [] if match and not match[1] else [match[1] if match else said.strip()]


def verdict(row, method, ranks, found):
    """Return the first outcome that is not as expected, or what all are."""
    for n, one in zip(ranks, found):
        if one.text.startswith("fails"):
            return one.text + (f" ({n} ranks)" if n > 1 else "")
        known = row.dense or isinstance(row.end, Refused) or row.end.asked
        if not known and not math.isclose(one.energy, found[0].energy, rel_tol=1e-4):
            return f"fails: energy {one.energy} on {n} ranks, {found[0].energy} on {ranks[0]}"
    wrong = unlike_dense(of_method(row, method)) if row.dense else []
    texts = list(dict.fromkeys(one.text for one in found))
    return "fails: " + "; ".join(wrong) if wrong else " / ".join(texts)


def timed(what, act):
    """Return the result of act(), and print on standard error how long it takes."""
    start = time.monotonic()
    result = act()
    print(f"{what}: {time.monotonic() - start:.0f} s", file=sys.stderr)
    return result


def examine_rows(rows, ranks):
    """Yield (row, method, outcomes on each number of ranks, verdict) of all rows."""
    pairs = [(row, method) for row in rows for method in row.methods]
    jobs = [(of_method(row, method), row.mesh and row.mesh()) for row, method in pairs]
    of_ranks = [timed(f"{n} ranks", lambda n=n: solve_many(jobs, n)) for n in ranks]
    for (row, method), runs in zip(pairs, zip(*of_ranks)):
        found = [outcome(row, run) for run in runs]
        yield row, method, found, verdict(row, method, ranks, found)
