"""Small changes of decks, as mistakes of a user or of a pre-processor make them."""

import collections
import re

# file: the name of the changed one of files; line: from 1; text: the change in words; keyword: the
# name of that of the line
Mutation = collections.namedtuple("Mutation", "kind files file line text keyword")

NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([EeDd][-+]?\d+)?$")
NAME = re.compile(r"^[A-Za-z_\"][\w. ,\"-]*$")
NAMING = ("NAME", "NSET", "ELSET", "MATERIAL", "INTERACTION", "SLAVE", "MASTER", "AMPLITUDE")
# Data words that are no names of the deck
LABELS = re.compile(r"^([PSN]\d?|GRAV|TRVEC|ENCASTRE|PINNED|[XYZ]A?SYMM|U|E|RF|CSTR|NOE|.* .*)$",
                    re.IGNORECASE)


def is_keyword(line):
    return re.match(r"\*[A-Za-z]", line) is not None


def is_data(line):
    return bool(line.strip()) and not line.startswith("*")


def words_of(line):
    return [word.strip() for word in line.split(",")]


def choose(lines, rng, fits):
    """Return the index of a line that fits. All blocks of keywords are equally probable, so that
    the many lines of nodes are not chosen most often. Return None if no line fits."""
    blocks, keyword = {}, 0
    for i, line in enumerate(lines):
        keyword = i if is_keyword(line) else keyword
        if fits(line):
            blocks.setdefault(keyword, []).append(i)
    return rng.choice(rng.choice(list(blocks.values()))) if blocks else None


def remove_keyword(lines, i, _):
    return lines[:i] + lines[i + 1:]


def misspell_keyword(lines, i, rng):
    name = re.match(r"\*[A-Za-z ]+", lines[i]).group(0).rstrip()
    k = rng.randrange(1, len(name))
    wrong = rng.choice([name[:k] + name[k + 1:], name[:k] + "X" + name[k + 1:],
                        name + "S" if name[-1] not in "Ss" else name[:-1]])
    return lines[:i] + [wrong + lines[i][len(name):]] + lines[i + 1:]


def double_line(lines, i, _):
    return lines[:i + 1] + lines[i:]


def rename(lines, i, rng):
    line = lines[i]
    if is_keyword(line):
        places = [m.end() for m in re.finditer(r"(\w+) *= *[^,=]+?(?= *(,|$))", line)
                  if m.group(1).upper() in NAMING]
    else:
        places = [m.end() for m in re.finditer(r"[^,]+?(?= *(,|$))", line)
                  if NAME.match(m.group(0).strip()) and not LABELS.match(m.group(0).strip())]
    if not places:
        return None
    place = rng.choice(places)
    if line[place - 1] == '"':
        place -= 1
    return lines[:i] + [line[:place] + "X" + line[place:]] + lines[i + 1:]


def remove_option(lines, i, rng):
    words = lines[i].split(",")
    if len(words) < 2 or words[-1].strip() == "":
        return None
    k = rng.randrange(1, len(words))
    return lines[:i] + [",".join(words[:k] + words[k + 1:])] + lines[i + 1:]


def swap_numbers(lines, i, rng):
    words = lines[i].split(",")
    numbers = [k for k, word in enumerate(words) if NUMBER.match(word.strip())]
    pairs = [(a, b) for a in numbers for b in numbers
             if a < b and float(words[a]) != float(words[b])]
    if not pairs:
        return None
    a, b = rng.choice(pairs)
    words[a], words[b] = words[b], words[a]
    return lines[:i] + [",".join(words)] + lines[i + 1:]


def comma_for_point(lines, i, rng):
    places = [m.start() for m in re.finditer(r"(?<=\d)\.(?=\d)", lines[i])]
    if not places:
        return None
    place = rng.choice(places)
    return lines[:i] + [lines[i][:place] + "," + lines[i][place + 1:]] + lines[i + 1:]


# kind -> change, and the lines that it takes
CHANGES = {"keyword removed": (remove_keyword, is_keyword),
           "keyword misspelt": (misspell_keyword, is_keyword),
           "keyword doubled": (double_line, is_keyword),
           "data line removed": (remove_keyword, is_data),
           "data line doubled": (double_line, is_data),
           "name changed": (rename, lambda line: is_keyword(line) or is_data(line)),
           "option removed": (remove_option, lambda line: is_keyword(line) and "," in line),
           "numbers swapped": (swap_numbers, is_data),
           "comma for point": (comma_for_point, is_data)}


def mutate(files, kind, rng):
    """Return a Mutation of files, {name: text}, of a kind, or None if 200 trials find none."""
    change, fits = CHANGES[kind]
    for _ in range(200):
        name = rng.choice(sorted(files))
        lines = files[name].splitlines()
        i = choose(lines, rng, fits)
        changed = None if i is None else change(lines, i, rng)
        if changed is None or changed == lines:
            continue
        now = changed[i] if kind not in ("keyword removed", "data line removed") else "removed"
        text = f"'{lines[i]}' -> " + ("twice" if "doubled" in kind else f"'{now}'")
        keyword = next((line for line in lines[i::-1] if is_keyword(line)), "*")
        return Mutation(kind, {**files, name: "\n".join(changed) + "\n"}, name, i + 1, text,
                        keyword[1:].partition(",")[0].strip().upper())
    return None
