"""Searches killed at random times and begun again: they take the same path bit for bit."""

import json
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import time

from runs import ROOT, SECONDS, command, environment

# What is killed: pairs of a scene and entries.
SEARCHES = [("tests/scenes/hertz-3d-small.prm", []),
            ("tests/scenes/repaired-2d.prm", []),
            ("tests/scenes/load-cases-2d.prm", ["Optimization/Maximum evaluations=12"])]
KILLS = 3  # of one search before it may end


def descendants(process):
    """Yield the numbers of a process and of all that it started."""
    yield process
    try:
        for child in pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split():
            yield from descendants(int(child))
    except OSError:
        pass


def start(scene, entries, output, ranks, restart):
    """Return the process of a search that begins."""
    return subprocess.Popen(command(ROOT / scene, entries, output, ranks) +
                            (["--restart"] if restart else []), env=environment(),
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def kill(process):
    """Kill a process and its ranks: without their launcher these would go on and write."""
    for one in list(descendants(process.pid)):
        try:
            os.kill(one, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.communicate(timeout=SECONDS)


def numbers(output):
    """Return designs and values of all evaluations, and the result; times may differ."""
    lines = [line for line in (output / "journal.txt").read_text().splitlines()
             if not line.startswith("notes")]
    return lines, json.loads((output / "summary.json").read_text())["optimization"]


def one_search(draw, scene, entries, ranks, kills):
    """Return how often a search was killed before its end, and what is wrong, if anything."""
    with tempfile.TemporaryDirectory() as directory:
        whole, output = pathlib.Path(directory, "whole"), pathlib.Path(directory, "killed")
        begin = time.monotonic()
        process = start(scene, entries, whole, ranks, False)
        said = process.communicate(timeout=SECONDS)[1]
        took = time.monotonic() - begin
        if process.returncode:
            return 0, f"exit {process.returncode}: {said.strip()}"
        killed = 0
        while True:
            process = start(scene, entries, output, ranks, killed > 0)
            try:
                said = process.communicate(
                    timeout=draw.uniform(.1, 1.) * took if killed < kills else SECONDS)[1]
            except subprocess.TimeoutExpired:
                kill(process)
                killed += 1
                continue
            if process.returncode:
                return killed, f"exit {process.returncode}: {said.strip()}"
            return killed, "" if numbers(output) == numbers(whole) else "another path"


def examine(ranks, kills):
    """Kill so many times on so many ranks; return the kills and the faults."""
    draw, done, faults, number = random.Random(ranks), 0, [], 0
    while done < kills:
        scene, entries = SEARCHES[number % len(SEARCHES)]
        times, fault = one_search(draw, scene, entries, ranks, min(KILLS, kills - done))
        done, number = done + times, number + 1
        if fault:
            faults.append(f"search {number}, {scene}, {ranks} ranks, killed {times} times: {fault}")
    return done, faults
