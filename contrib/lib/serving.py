"""Resident processes of the program, `snug --serve`, with what they take of the machine."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

from runs import ROOT, built, environment, parallel


def descendants(pid):
    """Return the numbers of the processes that a process started, and of those that these did."""
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            for child in task.read_text(encoding="ascii").split():
                found += [int(child), *descendants(int(child))]
        except (FileNotFoundError, ProcessLookupError):
            pass
    return found


def is_running(pid):
    """Return whether a process runs; one that ended and was not waited for does not."""
    try:
        text = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
        return text.rpartition(")")[2].split()[0] not in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return False


def seconds_until_gone(pids, patience=30.):
    """Return the seconds until none of the processes runs, or infinity. Processes that are left
    are ended."""
    begin = time.monotonic()
    while any(map(is_running, pids)):
        if time.monotonic() - begin > patience:
            for pid in filter(is_running, pids):
                os.kill(pid, signal.SIGKILL)
            return float("inf")
        time.sleep(.02)
    return time.monotonic() - begin


def cpu_seconds(pid):
    """Return the seconds of the processor that all threads of a process have taken."""
    return 1e-9 * sum(int(file.read_text(encoding="ascii").split()[0])
                      for file in pathlib.Path(f"/proc/{pid}/task").glob("*/schedstat"))


class Served:
    """This class is a process that answers requests about a parameter file. Without an answer
    of the first line, it throws the end of the log."""

    def __init__(self, file, entries=(), ranks=1):
        words = [*parallel(ranks), built("SNUG", "snug"), "--serve", str(ROOT / file),
                 *(word for one in entries for word in ("--set", one))]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True, env=environment(),
                                        start_new_session=True)
        self.ready = json.loads(self.process.stdout.readline())
        # the ranks, without their launcher
        started = descendants(self.process.pid) if ranks > 1 else [self.process.pid]
        self.ranks = [pid for pid in started
                      if pathlib.Path(f"/proc/{pid}/comm").read_text(encoding="utf-8") == "snug\n"]

    def send(self, do, **keys):
        self.process.stdin.write(json.dumps({"do": do, **keys}) + "\n")
        self.process.stdin.flush()

    def line(self, text):
        """Return the answer to a line."""
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def ask(self, do, **keys):
        return self.line(json.dumps({"do": do, **keys}))

    def evaluate(self, x, **keys):
        """Return the answer to an evaluation, which must succeed."""
        answer = self.ask("evaluate", x=x, **keys)
        if "error" in answer:
            raise ValueError(answer["error"]["message"])
        return answer

    def cpu(self):
        """Return the seconds of the processor that all ranks have taken."""
        return sum(map(cpu_seconds, self.ranks))

    def megabytes(self):
        """Return the resident memory of the largest rank."""
        return max(int(line.split()[1]) / 1024 for pid in self.ranks
                   for line in pathlib.Path(f"/proc/{pid}/status").read_text("utf-8").splitlines()
                   if line.startswith("VmRSS"))

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.process.stdin.close()
        seconds_until_gone([self.process.pid, *self.ranks])
        self.process.wait()
        self.process.stdout.close()


KILLED = """
import json, os, signal, sys
sys.path.insert(0, sys.argv[1])
from serving import Served
server = Served(*json.loads(sys.argv[2]))
for _ in range(3):
    server.send("evaluate", gradients=True)
print(json.dumps([server.process.pid, *server.ranks]), flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


def seconds_after_killed_client(file, entries=(), ranks=1):
    """Return the seconds until all processes of the program have ended after SIGKILL of a client
    whose three requests are in the pipe."""
    folder = str(pathlib.Path(__file__).parent)
    done = subprocess.run([sys.executable, "-c", KILLED, folder,
                           json.dumps([str(file), list(entries), ranks])],
                          stdout=subprocess.PIPE, text=True, check=False)
    return seconds_until_gone(json.loads(done.stdout))
