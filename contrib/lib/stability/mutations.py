"""Parameter files with a few faults: each must be solved or refused with one line."""

import collections
import pathlib
import random
import re
import tempfile

from runs import ROOT, changed

from many import run_many

# Read and checked only: they take long to solve.
LARGE = ROOT / "prm"
SMALL = ROOT / "tests/scenes"

VALUES = ["", "0", "-1", "1", "nan", "inf", "-inf", "1e300", "-1e300", "1e-300", "1e400", "-0",
          "2147483648", "99999999999999999999", "-2", "0.5", "1e", ".", "+", "x", "%$", ",", ";",
          ":", ",,", "a: b", "a: b, a: b", "sqrt(-1)", "1/0", "x^", "((((", "sin(x", "1 2 3",
          "0 0 0", "0, 0", "1, 1, 1, 1", "true", "none", "auto", "all", "../..", "/dev/null",
          "\u00e9\u4e2d", "\\", "\"", "'", "#", "$(ls)", "set", "end", "subsection", "log(-x)",
          "1e999*x", "exp(1000*x)", "if(x > 0, 1, 0/0)", "A" * 5000, "(" * 500, "1," * 500]
# What such entries count, a search or a mesh takes time for.
COUNTS = re.compile("cells|refinements|subdomains|control points|evaluations|degree|f-mults"
                    "|update pairing", re.IGNORECASE)
ENTRY = re.compile(r"^(\s*set\s+)([^=]*?)(\s*=\s*)(.*)$")
NUMBER = re.compile(r"(?<![\w.])\d+\.?\d*(?:[eE][-+]?\d+)?")


def another_number(draw, name, text):
    """Return a number that is close or far; of counts few more, or too many for any machine."""
    value = float(text)
    if COUNTS.search(name):
        return str(draw.choice((0, 1, 2, int(value) + 1, 10**9, 10**18, 2.5, -3)))
    factor = draw.choice((0., -1., 2., .5, .9, 1.1, 1.001, 3., 1e3, 1e-3, 1e9, 1e-9, 1e30, 1e-30))
    return repr(value * factor)


def of_value(draw, lines, i):
    """Give an entry a hostile value, that of another entry, or change one number of it."""
    match = ENTRY.match(lines[i])
    if not match:
        return of_line(draw, lines, i)
    name, value = match[2], match[4]
    way = draw.randrange(6)
    if way == 0:
        value = draw.choice(VALUES)
        if COUNTS.search(name) and value == "2147483648":
            value = "2"
    elif way == 1:
        others = [other[4] for other in map(ENTRY.match, lines) if other]
        value = draw.choice(others)
    else:
        numbers = list(NUMBER.finditer(value))
        if not numbers:
            return of_text(draw, lines, i)
        one = draw.choice(numbers)
        value = value[:one.start()] + another_number(draw, name, one[0]) + value[one.end():]
    lines[i] = match[1] + name + match[3] + value
    return lines


def of_line(draw, lines, i):
    """Leave a line out, repeat it, move it, or cut it off."""
    way = draw.randrange(5)
    if way == 0:
        del lines[i]
    elif way == 1:
        lines.insert(draw.randrange(len(lines)), lines[i])
    elif way == 2:
        lines.insert(draw.randrange(len(lines)), lines.pop(i))
    elif way == 3:
        lines[i] = lines[i][:draw.randrange(len(lines[i]) + 1)]
    else:
        lines = lines[:i + 1]
    return lines


def of_text(draw, lines, i):
    """Change a character or a word."""
    line, way = lines[i], draw.randrange(4)
    at = draw.randrange(len(line) + 1)
    if way == 0:
        line = line[:at] + line[at + 1:]
    elif way == 1:
        # digits of counts would make meshes that take long
        line = line[:at] + chr(draw.choice((draw.randrange(32, 48), draw.randrange(58, 127), 0, 9,
                                            27, 233, 8364))) + line[at:]
    elif way == 2:
        words = line.split(" ")
        draw.shuffle(words)
        line = " ".join(words)
    else:
        words = " ".join(lines).split()
        line = line[:at] + draw.choice(words) + line[at:] if not COUNTS.search(line) else line
    lines[i] = line
    return lines


def mutated(draw, text):
    """Return a text with one to three faults."""
    lines = text.splitlines()
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        places = [i for i, line in enumerate(lines) if line.strip() and line.strip()[0] != "#"]
        if not places:
            break
        way = draw.choice((of_value, of_value, of_value, of_value, of_line, of_text))
        lines = way(draw, lines, draw.choice(places))
    return "\n".join(lines) + "\n"


def original_of(number):
    originals = sorted(SMALL.glob("*.prm")) + sorted(LARGE.glob("*.prm"))
    return originals[number % len(originals)]


def text(number):
    """Return the file of a number, which finds its meshes in any directory."""
    return mutated(random.Random(number), changed(original_of(number), {}))


def make(number, directory):
    """Write the file of a number, and return the arguments of its run."""
    path = directory / f"mutated-{number}.prm"
    path.write_text(text(number))
    return [str(path), f"--output={directory / 'output'}",
            "--set=Optimization/Maximum evaluations=2",
            # Targets that no mesh meets are not hangs.
            "--set=Accuracy/Maximum unknowns=10000",
            *(["--validate"] if original_of(number).parent == LARGE else [])]


def fault(end):
    """Return what is wrong with how a run ended, or nothing."""
    if end.status == 0:
        return "" if end.lines == 0 else f"exit 0, but says: {end.message}"
    if end.status < 0:
        return f"ends with signal {-end.status}"
    if end.status in (2, 3) and end.lines == 1 and end.message.startswith("snug: "):
        return ""
    return f"exit {end.status}, {end.lines} lines: {end.message}"


def examine(numbers):
    """Return {exit status: files}, the faults and the CPU seconds of all files together."""
    with tempfile.TemporaryDirectory() as directory:
        ends = run_many([make(number, pathlib.Path(directory)) for number in numbers])
    faults = [f"mutated file {number}: {fault(end)} ({end.seconds:.1f} s)"
              for number, end in zip(numbers, ends) if fault(end)]
    return (collections.Counter(end.status for end in ends), faults,
            sum(end.seconds for end in ends))
