"""Find CalculiX, and read its nodal results from a file .frd."""

import platform
import shutil
import sys

SKIPPED = 77  # SKIP_RETURN_CODE in tests/CMakeLists.txt


def require_ccx():
    """End the program if the program ccx is missing: as a skipped test on Debian 13, which has no
    package calculix-ccx, and with an error on other systems."""
    if shutil.which("ccx"):
        return
    system = platform.freedesktop_os_release()
    if (system["ID"], system.get("VERSION_ID")) == ("debian", "13"):
        print("skipped: the program ccx is missing, and Debian 13 has no package calculix-ccx")
        sys.exit(SKIPPED)
    raise SystemExit("the program ccx is missing. On Debian 12: apt install calculix-ccx")


def fields(path, name):
    """Return {step: {node: components}} of the blocks called @p name, such as DISP or CONTACT, at
    the end of each step."""
    steps, step, is_inside = {}, 0, False
    for line in path.read_text().splitlines():
        if line.startswith("    1PSTEP"):
            step = int(line.split()[3])  # behind the number of the block and the increment
        elif line.startswith(" -4"):
            is_inside = line.split()[1] == name
            if is_inside:
                steps[step] = {}
        elif line.startswith(" -3"):
            is_inside = False
        elif is_inside and line.startswith(" -1"):
            # a mark of 3 characters, a node of 10 and numbers of 12
            numbers = [line[i:i + 12] for i in range(13, len(line.rstrip()), 12)]
            steps[step][int(line[3:13])] = [float(number) for number in numbers]
    return steps


def field(path, name):
    """Return {node: components} of the last block called @p name."""
    steps = fields(path, name)
    return steps[max(steps)] if steps else {}
