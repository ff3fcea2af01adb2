"""Measures of small scenes.

A check runs a scene with some entries and measures it, where it says so beside the
same scene with others. A measure returns quantities as (name, value, answer)."""

import collections
import math


class Below(float):
    """An answer that is a bound: the value must be smaller."""


Check = collections.namedtuple("Check", "scene entries measure allowed beside",
                               defaults=[1e-8, None])


def error(value, answer):
    """Relative, of lists to their largest number; of a bound that holds zero."""
    if isinstance(answer, Below):
        return 0. if value < answer else math.inf
    found, known = (x if isinstance(x, list) else [x] for x in (value, answer))
    if len(found) != len(known) or not all(map(math.isfinite, found)):
        return math.inf
    return max(abs(a - b) for a, b in zip(found, known)) / max(map(abs, known))


def at(result, path):
    """What stands in the summary at "state.energy"."""
    value = result.summary
    for key in path.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def same(*paths, less=(), more=()):
    """Equal to the scene beside; some numbers are less, or more."""
    return lambda result, beside: [
        *((path, at(result, path), at(beside, path)) for path in paths),
        *((path, at(result, path), Below(at(beside, path))) for path in less),
        *((path + " beside", at(beside, path), Below(at(result, path)))
          for path in more)]
