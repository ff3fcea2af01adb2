"""Lines that tests run, by module: coverage.py SUMMARY, of gcovr --json-summary."""

import collections
import json
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        summary = json.load(file)
    of_module = collections.defaultdict(lambda: [0, 0])
    for entry in summary["files"]:
        parts = entry["filename"].split("/")
        for name in (parts[2 if parts[0] == "include" else 1], "all"):
            of_module[name][0] += entry["line_covered"]
            of_module[name][1] += entry["line_total"]
    all_lines = of_module.pop("all", [0, 0])
    print(f"{'module':15} {'lines':>7} {'run':>7} {'%':>6}")
    for name, (run, total) in [*sorted(of_module.items()), ("all", all_lines)]:
        print(f"{name:15} {total:7} {run:7} {100 * run / max(total, 1):6.1f}")


if __name__ == "__main__":
    main()
