"""Many runs of snug in one start of a program, which takes longer than most of them."""

import collections
import pathlib
import subprocess
import tempfile

from runs import Result, Run, built, environment, parallel

# status: below zero that of a signal, or -1 if all ranks ended; lines: on standard error;
# message: the last of them.
End = collections.namedtuple("End", "status seconds lines message")

SECONDS, MEGABYTES = 60, 3000  # of one run on one rank


def run_many(runs, ranks=1, cwd=None):
    """Return the End of each list of arguments."""
    program = [*parallel(ranks), built("SNUG_MANY", "tests/stability/stability.many"),
               str(SECONDS), str(MEGABYTES)]
    ends = []
    while len(ends) < len(runs):
        left = runs[len(ends):]
        try:
            said = subprocess.run(
                program, input="".join("\t".join(one) + "\n" for one in left), text=True, cwd=cwd,
                env=environment(), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                errors="replace", timeout=SECONDS * (10 + len(left)), check=False).stdout
        except subprocess.TimeoutExpired as stopped:
            said = (stopped.stdout or b"").decode(errors="replace")
        for line in said.splitlines():
            status, seconds, lines, message = line.split("\t", 3)
            ends.append(End(int(status), float(seconds), int(lines), message))
        if said.count("\n") < len(left):
            ends.append(End(-1, 0., 0, "all ranks ended, or none does"))
    return ends


def solve_many(jobs, ranks):
    """Return the Run of each (text, bytes of mesh.msh or None)."""
    with tempfile.TemporaryDirectory() as directory:
        places = [pathlib.Path(directory, str(i)) for i in range(len(jobs))]
        for place, (text, mesh) in zip(places, jobs):
            place.mkdir()
            (place / "scene.prm").write_text(text)
            if mesh:
                (place / "mesh.msh").write_bytes(mesh)
        ends = run_many([[str(place / "scene.prm"), f"--output={place / 'output'}"]
                         for place in places], ranks)
        return [Run(end.status, end.message, None if end.status else Result(place / "output"))
                for place, end in zip(places, ends)]
