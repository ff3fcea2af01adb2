#!/usr/bin/env python3
"""What 4 ranks send each other per F-mult: messages.py SNUG COUNTER, the library count_messages.

A cantilever without contacts is solved to two tolerances on the same path. Between both ends, each
F-mult is one iteration of conjugate gradients (source/qp/pcpg.cc), and each outer iteration of the
active set goes on on the same set (source/qp/active_set.cc), so that the differences of the counts are
exact. Counts at the start and at the end of the solve, and those of the setup, cancel. The balance in
the summary has the messages of an F-mult, which are those of the preconditioner as well."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "contrib/lib"))

from benchmarks import Case, summary_of  # noqa: E402

ENTRIES = ["Task=state", "Accuracy/Estimate=none", "Element degree=1", "Body beam/Box cells=32, 8",
           "Decomposition/Subdomains=16", "Solver/Soft modes=none",
           "Solver/Preconditioner=lumped"]
RANKS = 4

# An application of F or of the preconditioner takes multipliers from their owners to the ranks of the
# subdomains, and sums go back. The ranks hold consecutive parts of the beam: one in the middle has two
# neighbours, shares the rows with one of them as their owner, and sends one message each way.
MESSAGES = {"f_mults": 2, "preconditioner_applications": 2}

# Iteration: projections of the residual and of the direction, norms, choice of
# the columns, products with earlier directions, products with F times the direction.
# Outer iteration: products of the residual with directions; projection and norms of the last residual;
# rigid amplitudes, twice; norms of the optimality conditions; G lambda; maximum of diag F and norms of
# lambda and G for the scale of that; largest force; whether the set changes.
COLLECTIVES = {"f_mults": 6, "outer_iterations": 12}


def counts_at(program, counter, tolerance):
    """Return the counts of work and of what was sent in the solve, and the summary."""
    case = Case("beam", "tests/scenes/beam.prm",
                [*ENTRIES, f"Solver/Relative tolerance={tolerance}"], RANKS)
    summary = summary_of(program, case, counter)
    return {**summary["work"], **summary["sent"]["solve"],
            "outer_iterations": summary["state"]["outer_iterations"]}, summary


def wrong_balance(summary, more):
    """Say what in the balance of the ranks is wrong."""
    balance = summary["balance"]
    applications = sum(more[work] for work in MESSAGES)
    sent = {name: more[counted] / applications
            for name, counted in (("messages", "messages"), ("bytes", "message_bytes"))}
    for name, value in sent.items():
        if balance["f_mult"][name] != value:
            yield f"{balance['f_mult'][name]} {name} of an F-mult, not {value}"
    for name, whole in (("subdomains", "subdomains"), ("cells", "cells")):
        if balance[name]["mean"] * RANKS != summary["mesh"][whole]:
            yield f"mean {name} of {balance[name]}"
    spreads = {**balance["seconds"], **{name: balance[name] for name in
                                        ("subdomains", "cells", "unknowns")}}
    for name, spread in spreads.items():
        # the mean of equal times is rounded
        if not spread["least"] <= spread["mean"] * (1 + 1e-12) <= spread["largest"] * (1 + 2e-12):
            yield f"{name} from {spread}"
    if not {"assembly", "factorization", "solve", "subdomain solves"} <= set(spreads):
        yield f"seconds of {sorted(spreads)}"


def main(program, counter):
    (loose, _), (tight, summary) = (counts_at(program, counter, tolerance)
                                    for tolerance in (1e-4, 1e-9))
    more = {name: tight[name] - loose[name] for name in tight}
    print(", ".join(f"{name} {loose[name]} to {tight[name]}" for name in (
        "f_mults", "preconditioner_applications", "outer_iterations", "messages", "collectives")))
    wrong = [] if more["f_mults"] >= 3 else ["too few F-mults to compare"]
    for name, of in (("messages", MESSAGES), ("collectives", COLLECTIVES)):
        expected = sum(each * more[work] for work, each in of.items())
        if more[name] != expected:
            text = " + ".join(f"{each} x {more[work]} {work}" for work, each in of.items())
            wrong.append(f"{more[name]} more {name}, not {text} = {expected}")
    wrong += wrong_balance(summary, more)
    print("\n".join(wrong) or "all as expected")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
