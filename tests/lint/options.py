"""Every entry of doc/parameters.md is shown, and so is every choice it has: in a scene
of prm/ or tests/scenes/, or as 'Section/Entry=value' in a page of the gallery or a
program of contrib/. The default of a choice is shown by every scene without the entry."""

import collections
import re

from files import lines, place, text_files

REFERENCE = "doc/parameters.md"
ROW = re.compile(r"^\| `([^`]+)` \| (?:`([^`]*)`)? \| (.*?) \| ")
IN_LIST = "a name in the list below"  # if the choices are too many for the table
LIST = re.compile(r"^`([^`]+)`:$")
CHOICE = re.compile(r"^\* `([^`]+)`: ")
NAMED = ("Material", "Body", "Load case", "Obstacle", "Reference point", "Bolt", "Pair", "Shape",
         "Response")

Entry = collections.namedtuple("Entry", "line section name default allowed choices")


def read_reference(root):
    """The entries; a section is its name in scenes without that of the thing: Body."""
    section, entries, listed = "", [], None
    for number, line in lines(root / REFERENCE):
        if line.startswith("## "):
            section = kind(line[3:].replace("subsection ", ""))
            section = "" if section == "Outside of subsections" else section
        row = ROW.match(line)
        if row:
            name, default, allowed = row.groups()
            choices = (allowed[7:].split(", ")
                       if allowed.startswith("one of ") else [])
            entries.append(Entry(number, section, name, default, allowed, choices))
        begin, choice = LIST.match(line), CHOICE.match(line)
        if begin:
            listed = next((entry.choices for entry in entries if entry.allowed == IN_LIST and
                           (entry.section, entry.name) == (section, begin.group(1))), None)
        if choice and listed is not None:
            listed.append(choice.group(1))
    return entries


def kind(section):
    """Body punch -> Body"""
    return next((name for name in NAMED if section.startswith(name + " ")), section)


def shown_in_scene(path):
    """(section, entry, value) of what a scene sets."""
    section = ""
    for _, line in lines(path):
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            section = kind(words[11:].strip())
        elif words == "end":
            section = ""
        elif words.startswith("set "):
            name, _, value = words[4:].partition("=")
            yield section, name.strip(), value.strip()


def in_text(entry, value=""):
    """Finds 'Section NAME/Entry=value' in a program or a page."""
    section = (f"{re.escape(entry.section)}(?: [^/\"'\n]+)?/" if entry.section else
               r"(?<![/\w])")
    end = re.escape(value) + r"(?![\w-])" if value else ""
    return re.compile(f"{section}{re.escape(entry.name)} ?= ?{end}")


def check(root):
    scenes = {shown for path in text_files(root, ("prm", "tests/scenes"), (".prm",))
              for shown in shown_in_scene(path)}
    entries_of_scenes = {shown[:2] for shown in scenes}
    text = "\n".join(line for path in text_files(root, ("contrib", "doc/gallery"))
                     if path.suffix in (".md", ".py", "") for _, line in lines(path))
    messages = []
    for entry in read_reference(root):
        here = f"{place(root, root / REFERENCE, entry.line)}: '{entry.section}/{entry.name}"
        key = (entry.section, entry.name)
        if key not in entries_of_scenes and not in_text(entry).search(text):
            messages.append(f"{here}' stands in no scene, page or program: show it in"
                            " tests/scenes and doc/gallery/small.md")
        messages += [f"{here}={choice}' stands in no scene, page or program"
                     for choice in entry.choices if choice != entry.default and
                     (*key, choice) not in scenes and
                     not in_text(entry, choice).search(text)]
    return messages
