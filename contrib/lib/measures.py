"""Measures of small scenes.

A check runs a scene with some entries and measures it, where it says so beside the same scene
with others. A measure returns quantities as (name, value, answer)."""

import collections
import math


class Below(float):
    """This class is an answer that is a bound: the value must be smaller."""


Check = collections.namedtuple("Check", "scene entries measure allowed beside",
                               defaults=[1e-8, None])


def error(value, answer):
    """Return the relative error, of lists to their largest number; of a bound that holds zero."""
    if isinstance(answer, Below):
        return 0. if value < answer else math.inf
    found, known = (x if isinstance(x, list) else [x] for x in (value, answer))
    if len(found) != len(known) or not all(map(math.isfinite, found)):
        return math.inf
    return max(abs(a - b) for a, b in zip(found, known)) / max(map(abs, known))


def at(result, path):
    """Return what stands in the summary at "state.energy"."""
    value = result.summary
    for key in path.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def values(answers):
    """Return the measure of {path in the summary: answer}."""
    return lambda result, _: [(path, at(result, path), answer)
                              for path, answer in answers.items()]


def same(*paths, less=(), more=()):
    """Return the measure that numbers are equal to those of the scene beside, less, or more."""
    return lambda result, beside: [
        *((path, at(result, path), at(beside, path)) for path in paths),
        *((path, at(result, path), Below(at(beside, path))) for path in less),
        *((path + " beside", at(beside, path), Below(at(result, path)))
          for path in more)]
