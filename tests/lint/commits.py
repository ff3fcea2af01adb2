"""Titles of commits are imperatives of at most 72 characters with one subject."""

import re
import subprocess

MAX_TITLE = 72
# Words that end like other forms of a verb, but are imperatives.
IMPERATIVES = {"Address", "Bring", "Embed", "Exceed", "Feed", "Focus", "Need", "Proceed", "Seed",
               "Speed"}
# First words of titles that describe instead of telling what to do.
NO_VERBS = {"A", "All", "An", "And", "At", "By", "For", "From", "How", "If", "In", "It", "More",
            "Most", "New", "No", "Of", "On", "One", "Only", "That", "The", "These", "This",
            "To", "What", "When", "Where", "Whether", "Why", "With", "Without", "Wip"}
OTHER_FORM = re.compile(r"[a-z](?<!s)s$|ed$|ing$")


def complaints(title):
    """What is wrong with a title, one text each."""
    word = re.split(r"[\s:,]", title, maxsplit=1)[0]
    is_verb = word in IMPERATIVES or (re.fullmatch(r"[A-Z][a-z]+", word) and
                                      word not in NO_VERBS and not OTHER_FORM.search(word))
    if not is_verb:
        yield f"begins with '{word}', not with an imperative such as Add, Fix or Reduce"
    if len(title) > MAX_TITLE:
        yield f"has {len(title)} characters, more than {MAX_TITLE}"
    if ";" in title:
        yield "has a semicolon: one commit has one subject"


def titles(root, base):
    """(short hash, title) of the commits since base, without it; of HEAD alone if base is
    empty. None without git or a repository, as in a release."""
    if not (root / ".git").exists():
        return []
    revisions = ["--no-merges", f"{base}..HEAD"] if base else ["-1", "HEAD"]
    try:
        done = subprocess.run(["git", "-C", str(root), "log", "--format=%h %s", *revisions],
                              text=True, stdout=subprocess.PIPE, check=True)
    except FileNotFoundError:
        return []
    return [line.split(" ", 1) for line in done.stdout.splitlines()]


def check(root, base=""):
    return [f"commit {name}: the title '{title}' {complaint}"
            for name, title in titles(root, base) for complaint in complaints(title)]
