#!/usr/bin/env python3
"""contrib/compare-runs sees what changed, and only that: compare_runs.py COMPARE SNUG SCENE.

The program itself against itself once; then against programs that leave what it left, but
for one change.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

OTHER_PROGRAM = """#!{python}
import json, pathlib, shutil, sys
output = pathlib.Path(sys.argv[sys.argv.index("--output") + 1])
shutil.copytree({result!r}, output)
summary = json.loads((output / "summary.json").read_text())
status = 0
{change}
(output / "summary.json").write_text(json.dumps(summary))
sys.exit(status)
"""

# What another program changes: options with which that must be seen, and must not.
CASES = {
    "pass": (None, []),
    "summary['state']['energy'] *= 1 + 1e-9": (["--figures", "1e-10"], ["--figures", "1e-8"]),
    "summary['state']['energy'] = float('nan')": (["--figures", "1"], None),
    "summary['state']['active_contacts'] += 1": ([], ["--figures", "1"]),
    "summary['state']['contact_force'].append(0)": (["--figures", "1"], None),
    "del summary['state']['compliance']": (["--figures", "1"], None),
    "summary['state']['certificate']['equilibrium'] = 1e-9": (None, []),
    "summary['work']['f_mults'] += 1": ([], ["--f-mults", "1"]),
    "summary['times']['total'] = 1e6": (None, []),
    "status = 3": (["--figures", "1"], None),
    "shutil.rmtree(output); sys.exit(0)": (["--figures", "1"], None),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("compare", "program", "scene"):
        parser.add_argument(name)
    args = parser.parse_args()
    failed = 0

    def expect(status, what, old, new, options=()):
        done = subprocess.run([sys.executable, "-B", args.compare, old, new, args.scene, *options],
                              text=True, capture_output=True, check=False)
        good = done.returncode == status and f"| {args.scene} |" in done.stdout
        print("good" if good else "WRONG", what, *options)
        if not good:
            print(f"status {done.returncode}, not {status}\n{done.stdout}{done.stderr}")
        return not good

    with tempfile.TemporaryDirectory() as folder:
        failed += expect(0, "the program itself", args.program, args.program)
        result = pathlib.Path(folder, "result")
        subprocess.run([args.program, args.scene, "--output", result], check=True,
                       stdout=subprocess.DEVNULL)

        def program(name, change):
            path = pathlib.Path(folder, name)
            path.write_text(OTHER_PROGRAM.format(python=sys.executable, result=str(result),
                                                 change=change))
            path.chmod(0o755)
            return str(path)

        same = program("same", "pass")
        for change, (seen, unseen) in CASES.items():
            other = program("other", change)
            if seen is not None:
                failed += expect(1, change, same, other, seen)
            if unseen is not None:
                failed += expect(0, change, same, other, unseen)
        nothing = program("nothing", "shutil.rmtree(output); sys.exit(1)")
        failed += expect(1, "two programs that leave nothing", nothing, nothing)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
