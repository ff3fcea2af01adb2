#!/usr/bin/env python3
"""Compare a summary.json with accepted numbers: compare.py SUMMARY REFERENCE.

Physical quantities must agree on every number of ranks, and so must what the solver
spent where the reference tells, for subdomains do not depend on it.
The reference is a flat list of values, with own tolerances where a quantity is
less sharp than RTOL (an optimized design: the stopping tolerance):

    {"certificate": 1e-09,
     "tolerances": {"optimization.design": 1e-4},
     "values": {"state.energy": -1.25, ...}}
"""

import argparse
import json
import pathlib
import sys

# The scenes are solved to 1e-9, energies and pressures to about 1e-7
# (relative) on any number of ranks; a change of the model is far above this.
RTOL = 1e-6
CERTIFICATE = 1e-6
# Iterations react to rounding: one more, or a tenth more, is no regression.
COUNT_RTOL = 0.1

PHYSICAL = {
    "mesh": ("bodies", "cells", "dofs", "contact_rows"),
    "state": ("energy", "compliance", "strain_energy", "contact_force",
              "contact_area", "max_pressure", "active_contacts"),
    "gradient": ("method", "values"),
    "optimization": ("algorithm", "objective_initial", "objective_final",
                     "stop_reason", "design"),
}
SPENT = {
    "state": ("outer_iterations", "f_mults", "linear_f_mults"),
    "gradient": ("f_mults",),
    "optimization": ("iterations", "evaluations"),
    "work": ("f_mults", "preconditioner_applications", "coarse_factorizations",
             "coarse_solves", "subdomain_solves", "symbolic_factorizations",
             "numeric_factorizations", "assembled_subdomains"),
}
SPENT_KEYS = {f"{section}.{key}" for section in SPENT
              for key in SPENT[section]}
# Equal subdomains share one on a rank: references are of one rank, more have more.
PER_RANK = {"work.symbolic_factorizations", "work.numeric_factorizations"}


def select(summary, table):
    """{"section.key": value} of the table's keys that the summary has; null is
    what the run did not compute."""
    return {f"{section}.{key}": summary[section][key]
            for section, keys in table.items() for key in keys
            if (summary.get(section) or {}).get(key) is not None}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def numbers(value):
    """A number or list of numbers as a flat list, else None."""
    if is_number(value):
        return [value]
    if isinstance(value, list) and all(map(is_number, value)):
        return value
    return None


def difference(value, wanted, rtol):
    """What is wrong with value, or None. Vectors are compared in the maximum
    norm, so that a component that is zero up to rounding is no trouble."""
    found, expected = numbers(value), numbers(wanted)
    if found is None or expected is None:
        return None if value == wanted else f"{value!r} instead of {wanted!r}"
    if len(found) != len(expected):
        return f"{len(found)} numbers instead of {len(expected)}"
    size = max(map(abs, expected), default=0)
    # Not any(... > ...): a NaN must fail.
    if all(abs(a - b) <= rtol * size for a, b in zip(found, expected)):
        return None
    return f"{value} instead of {wanted} (relative tolerance {rtol:.0e})"


def count_difference(value, wanted, least=1):
    """Like difference(), for what the solver spent."""
    if is_number(value) and abs(value - wanted) <= max(least, COUNT_RTOL * wanted):
        return None
    return f"{value} instead of {wanted:g} (at most 10 % or {least} off)"


def compare(summary, reference, ranks):
    """Messages about what differs."""
    messages = []
    values = reference.get("values", {})
    tolerances = reference.get("tolerances", {})
    physical, spent = select(summary, PHYSICAL), select(summary, SPENT)
    for key, wanted in values.items():
        if key in PER_RANK and ranks > 1:
            if not (is_number(spent.get(key)) and spent[key] >= 0.9 * wanted - 1):
                messages.append((key, f"{spent.get(key)} is less than {wanted:g}"))
        elif key in SPENT_KEYS:
            messages.append((key, count_difference(spent.get(key), wanted)))
        else:
            messages.append((key, difference(physical.get(key), wanted,
                                             tolerances.get(key, RTOL))))
    bound = reference.get("certificate", CERTIFICATE)
    certificate = (summary.get("state") or {}).get("certificate")
    if not certificate:
        messages.append(("state.certificate", "missing"))
    for key, value in (certificate or {}).items():
        if not (is_number(value) and value <= bound):
            messages.append((f"state.certificate.{key}",
                             f"{value} is above {bound}"))
    found_ranks = summary.get("program", {}).get("ranks")
    if found_ranks != ranks:
        messages.append(("program.ranks", f"{found_ranks} instead of {ranks}"))
    if not values:
        messages.append(("values", "the reference has none"))
    return [f"{key}: {text}" for key, text in messages if text is not None]


def accepted(summary, reference):
    """The reference with the summary's values; its tolerances stay."""
    values = {**select(summary, PHYSICAL), **select(summary, SPENT)}
    kept = {key: reference[key] for key in ("certificate", "tolerances")
            if key in reference}
    return {**kept, "values": values}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("summary", type=pathlib.Path)
    parser.add_argument("reference", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--accept", action="store_true",
                        help="write the summary's values into the reference")
    options = parser.parse_args()
    summary = json.loads(options.summary.read_text(encoding="utf-8"))
    reference = {}
    if options.reference.is_file():
        reference = json.loads(options.reference.read_text(encoding="utf-8"))
    if options.accept:
        if summary["program"]["ranks"] != 1:
            sys.exit("accept the run on 1 rank: it alone has the iterations")
        text = json.dumps(accepted(summary, reference), indent=2)
        options.reference.write_text(text + "\n", encoding="utf-8")
        return 0
    messages = compare(summary, reference, options.ranks)
    for message in messages:
        print(f"{options.reference}: {message}")
    if messages and options.ranks == 1:
        print(f"accept with: {sys.argv[0]} --accept {options.summary}"
              f" {options.reference}")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
