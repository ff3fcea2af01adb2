"""The program as a process that answers lines of JSON, `snug --serve`."""

import collections
import json
import os
import shutil
import signal
import subprocess
import threading
import weakref

from .errors import Died, InputError, error_of


def find_program(program=None):
    """Return the path of the program: `program`, the variable SNUG, or snug on the PATH."""
    found = program or os.environ.get("SNUG") or shutil.which("snug")
    if not found:
        raise FileNotFoundError("the program snug was not found: set the variable SNUG, or add "
                                "its directory to PATH")
    return os.fspath(found)


class Process:
    """This class sends requests and reads answers. An answer that takes longer than `timeout`
    seconds ends the process."""

    def __init__(self, command, timeout=None):
        self.timeout, self.log, self.n = timeout, collections.deque(maxlen=200), 0
        # In a session of its own, because otherwise Ctrl-C in a notebook also ends the program.
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, encoding="utf-8", errors="replace", start_new_session=True)
        # The program of a forgotten model ends, too: subprocess itself keeps the pipe open.
        weakref.finalize(self, self.process.stdin.close)
        self.drain = threading.Thread(target=self.log.extend, args=(self.process.stderr,),
                                      daemon=True)
        self.drain.start()  # because a full pipe would block the program
        try:
            self.ready = self.read()
        except Died as death:
            self.close()
            if death.status == 2:
                raise InputError("".join(death.log).strip().rpartition("\n")[2]) from None
            raise

    def read(self):
        """Return the next answer."""
        timer = threading.Timer(self.timeout, self.kill) if self.timeout else None
        if timer:
            timer.start()
        line = self.process.stdout.readline()
        is_late = timer and not timer.is_alive()
        if timer:
            timer.cancel()
        if not line:
            status = self.process.wait()
            self.drain.join(1.)
            raise Died(self.death(status, is_late), status, list(self.log))
        return json.loads(line)

    def death(self, status, is_late):
        """Return how the process ended, its own last message, and the end of the log."""
        cause = (f"no answer in {self.timeout} s" if is_late else f"exit status {status}"
                 if status >= 0 else f"signal {signal.Signals(-status).name}")
        lines = [line for line in self.log if line.strip(" -\n")]  # mpirun rules its messages
        own = [line for line in lines[:-5] if line.startswith("snug: ")]
        return f"the program snug ended ({cause}): {''.join(own[-1:] + lines[-5:]).strip()}"

    def call(self, do, **keys):
        """Return the answer to a request, or raise its error."""
        self.n += 1
        try:
            self.process.stdin.write(json.dumps({"id": self.n, "do": do, **keys}) + "\n")
            self.process.stdin.flush()
        except (BrokenPipeError, ValueError):  # ValueError: the pipe is closed
            if self.process.stdin.closed:
                raise Died("the model is closed", self.process.poll(), list(self.log)) from None
        answer = self.read()
        while answer["id"] not in (self.n, None):  # of a request that Ctrl-C left
            answer = self.read()
        if "error" in answer:
            raise error_of(answer["error"])
        return answer

    def kill(self):
        """End the process and, with several ranks, all processes of its session."""
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def close(self):
        """End the process by the end of its input, or after 10 s by a signal."""
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        try:
            self.process.wait(10.)
        except subprocess.TimeoutExpired:
            self.kill()
            self.process.wait()
        self.drain.join(1.)
        self.process.stdout.close()
        self.process.stderr.close()
