"""Links and pictures of the markdown files lead to files that exist."""

import re

from files import lines, place, text_files

LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)")
ELSEWHERE = re.compile(r"^(https?:|mailto:|#)")


def check_file(root, path):
    in_code = False
    for number, line in lines(path):
        if line.lstrip().startswith("```"):
            in_code = not in_code
        if in_code:
            continue
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            file = path.parent / target.split("#")[0]
            if not ELSEWHERE.match(target) and not file.exists():
                yield f"{place(root, path, number)}: no file '{target}'"


def check(root):
    paths = sorted(root.glob("*.md"))
    paths += text_files(root, suffixes=(".md",))
    return [message for path in paths for message in check_file(root, path)]
