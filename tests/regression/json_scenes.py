#!/usr/bin/env python3
"""Models in JSON against their parameter files, and wrong models against the schema:
json_scenes.py SNUG [--all] [--mutants N].

Without --all every tenth file of prm/ and tests/scenes is read as JSON. If the package jsonschema
is installed, it has to agree with the validator of this file.
"""

import argparse
import copy
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
# Files without CAD or mesh files, whose mutants are quickly validated if they are good.
MUTATED = ["tests/scenes/two-blocks-3d.prm", "tests/scenes/hertz-2d-small.prm",
           "tests/scenes/friction-entries.prm", "prm/hertz-3d-9.prm"]
KINDS = {"string": str, "number": (int, float), "boolean": bool, "array": list, "object": dict,
         "integer": (int, float)}


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True, capture_output=True,
                          timeout=120, check=False)


def entries_of(path):
    """Return {section: {entry: text}} of a parameter file."""
    text = re.sub(r"\\\n\s*", "", re.sub(r"#.*", "", path.read_text(encoding="utf-8")))
    sections, section = {"": {}}, ""
    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "subsection":
            section = " ".join(rest.split())
            sections.setdefault(section, {})
        elif word == "end":
            section = ""
        elif word == "set":
            name, _, value = rest.partition("=")
            sections[section][" ".join(name.split())] = value.strip()
    return sections


def section_schema(section):
    if section in SCHEMA["properties"]:
        return SCHEMA["properties"][section]
    return next(part for pattern, part in SCHEMA["patternProperties"].items()
                if re.search(pattern, section))


def value_of(text, schema):
    """Return the JSON value of a text that has the form of an entry."""
    if "anyOf" in schema:  # numbers of load cases, or formulas of the case number
        try:
            return value_of(text, schema["anyOf"][0])
        except ValueError:
            return text
    if "enum" in schema:
        return text if text in schema["enum"] else json.loads(text)
    kind = schema["type"]
    if kind == "array":
        names = schema["items"]["type"] == "string"
        parts = text.split(",") if names or "," in text else text.split()
        return [value_of(part.strip(), schema["items"]) for part in parts if part.strip()]
    if kind == "boolean":
        return text == "true"
    return {"number": float, "integer": int}.get(str(kind), str)(text)


def as_json(path):
    sections = entries_of(path)
    scene = {name: value_of(text, SCHEMA["properties"][name])
             for name, text in sections.pop("").items()}
    for section, entries in sections.items():
        known = section_schema(section)["properties"]
        scene[section] = {name: value_of(text, known[name]) for name, text in entries.items()}
    return scene


def is_kind(value, kind):
    return isinstance(value, KINDS[kind]) and (kind == "boolean" or not isinstance(value, bool)) \
        and (kind != "integer" or value == int(value))


def errors(value, schema, path=()):
    """Return the paths of the parts of a value that violate a schema, in the form of Snug's."""
    if "anyOf" in schema:
        return [] if any(not errors(value, part) for part in schema["anyOf"]) else [path]
    kinds = schema.get("type", [])
    good = ("enum" not in schema or
            any(value == one and isinstance(value, bool) == isinstance(one, bool)
                for one in schema["enum"]))
    if kinds:
        good = any(is_kind(value, kind) for kind in ([kinds] if isinstance(kinds, str) else kinds))
    if good and is_kind(value, "number"):
        good = (schema.get("minimum", value) <= value <= schema.get("maximum", value) and
                value > schema.get("exclusiveMinimum", -math.inf) and
                value < schema.get("exclusiveMaximum", math.inf))
    if good and isinstance(value, list):
        good = (len(value) <= schema.get("maxItems", len(value)) and
                not any(errors(part, schema["items"]) for part in value))
    found = [] if good else [path]
    for name, part in value.items() if good and isinstance(value, dict) else []:
        known = schema.get("properties", {}).get(name) or next(
            (of for pattern, of in schema.get("patternProperties", {}).items()
             if re.search(pattern, name)), None)
        found += [(*path, name)] if known is None else errors(part, known, (*path, name))
    return found


def mutant(scene, random_numbers):
    """Return a scene with one change of one value, entry or section."""
    scene = copy.deepcopy(scene)
    section = random_numbers.choice([name for name in scene])
    of = scene[section] if isinstance(scene[section], dict) and scene[section] else scene
    name = random_numbers.choice(list(of)) if of is not scene else section
    value = of[name]
    change = random_numbers.randrange(6)
    if change == 0:
        of[name + random_numbers.choice(["s", " 2"])] = of.pop(name)
    elif change == 1 and isinstance(value, list) and value:
        value[random_numbers.randrange(len(value))] = random_numbers.choice(["x", None, -1, [1]])
    elif change == 2 and is_kind(value, "number"):
        of[name] = random_numbers.choice([-value, 1e9 * value + 1, value + 0.5, 0])
    elif change == 3 and isinstance(value, str):
        of[name] = value + "x"
    else:
        of[name] = random_numbers.choice([None, "text", -1, 1e300, True, [], [1, 2], ["a"]])
    return scene


class JsonScenes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, scene):
        path = pathlib.Path(self.folder.name) / "scene.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        return path

    def test_files_as_json(self):
        files = sorted([*ROOT.glob("prm/*.prm"), *ROOT.glob("tests/scenes/*.prm")])
        for path in files if ALL else files[::10]:
            with self.subTest(path.name):
                scene = as_json(path)
                self.assertEqual(errors(scene, SCHEMA), [])
                for body in scene.values():  # the JSON is in another directory
                    if isinstance(body, dict) and body.get("File"):
                        body["File"] = str(path.parent / body["File"])
                of_json, of_file = run("--translate", self.write(scene)), run("--translate", path)
                self.assertEqual((of_json.returncode, of_file.returncode), (0, 0), of_json.stderr)
                self.assertEqual(of_json.stdout, of_file.stdout)

    def test_mutants(self):
        random_numbers = random.Random(55)
        refused = 0
        for number in range(MUTANTS):
            scene = mutant(as_json(ROOT / MUTATED[number % len(MUTATED)]), random_numbers)
            expected = errors(scene, SCHEMA)
            if VALIDATOR is not None:
                self.assertEqual(bool(expected), not VALIDATOR.is_valid(scene), scene)
            if not expected:
                continue
            refused += 1
            done = run("--validate=json", self.write(scene))
            answer = json.loads(done.stdout)
            with self.subTest(number=number, path=expected):
                self.assertEqual((done.returncode, answer["valid"]), (2, False))
                self.assertEqual(answer["error"].get("entry"), "/".join(expected[0]),
                                 answer["error"])
        self.assertGreater(refused, MUTANTS // 3)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--mutants", type=int, default=24)
    given = parser.parse_args()
    PROGRAM, ALL, MUTANTS = given.program, given.all, given.mutants
    SCHEMA = json.loads(run("--print-parameters=json").stdout)
    try:
        import jsonschema
        VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
    except ImportError:
        VALIDATOR = None
    unittest.main(argv=sys.argv[:1])
