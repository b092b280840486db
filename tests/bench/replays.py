#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Measures what recording costs and what replays take, beside a run that does neither.

All kinds take turns, so that what else the machine does falls upon all alike. Prints two tables;
tests/bench/run puts them into README.md.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

RECORDINGS = {"nothing": [], "rays": ["--record", "rays"], "memory": ["--record", "memory"]}


class Measured:
    """One command with its wall time, its processor time, and what it counted."""

    def __init__(self, command, out):
        start = time.monotonic()
        child = subprocess.Popen([*command, "--quiet", "--out", out], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        self.wall = time.monotonic() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            raise SystemExit(f"{' '.join(command)} ended with {child.returncode}")
        self.processor = usage.ru_utime + usage.ru_stime
        self.stats = json.loads((Path(out) / "stats.json").read_text())

    def rays(self):
        return self.stats["rays.num_retired"]["value"]

    def accesses(self):
        """Of all units to their private caches."""
        return sum(entry["value"] for name, entry in self.stats.items()
                   if name.endswith("cache.num_accesses") and name.startswith("system."))


def in_turns(commands, folder, repeats):
    """Each command so many times, in rounds: name -> measurements. The first round is not counted."""
    runs = {name: [] for name in commands}
    for _ in range(repeats + 1):
        for name, command in commands.items():
            runs[name].append(Measured(command, f"{folder}/{name.replace(' ', '-')}"))
    return {name: all_runs[1:] for name, all_runs in runs.items()}


def median(runs, what):
    return statistics.median(getattr(run, what) for run in runs)


def ratio(runs, base, what):
    """Median of the ratios of runs of the same round."""
    pairs = zip(runs, base, strict=True)
    return statistics.median(getattr(run, what) / getattr(other, what) for run, other in pairs)


def tables(sheaf, scene, settings, repeats):
    """Recording and replaying of one scene: two tables."""
    words = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        cache = ["--cache", f"{folder}/trees"]
        live = [sheaf, "run", scene, *words, "--no-images", *cache]
        commands = {name: live + more for name, more in RECORDINGS.items()}
        recorded = in_turns(commands, folder, repeats)
        rays, memory = (f"{folder}/{kind}/{kind}.trace" for kind in ("rays", "memory"))
        sizes = {"rays": Path(rays).stat().st_size, "memory": Path(memory).stat().st_size}
        replays = in_turns({
            "live run": live,
            "ray trace": [sheaf, "replay", rays, "--scene", scene, *cache],
            "memory trace elastic": [sheaf, "replay", memory],
            "memory trace fixed": [sheaf, "replay", memory, "--mode", "fixed"],
        }, folder, repeats)
    plain = recorded["nothing"]
    num_rays, num_accesses = plain[0].rays(), plain[0].accesses()
    recording = ["| recorded | wall time | processor time | bytes a ray | MB/s |",
                 "| --- | --- | --- | --- | --- |"]
    for kind, size in sizes.items():
        runs = recorded[kind]
        recording.append(f"| {kind} | {100 * ratio(runs, plain, 'wall') - 100:+.1f} % "
                         f"| {100 * ratio(runs, plain, 'processor') - 100:+.1f} % "
                         f"| {size / num_rays:.1f} | {1e-6 * size / median(runs, 'wall'):.1f} |")
    replaying = ["| | of the live run's processor time | million rays a second "
                 "| million accesses a second |", "| --- | --- | --- | --- |"]
    for name, runs in replays.items():
        seconds = median(runs, "processor")
        share = ratio(runs, replays["live run"], "processor")
        replaying.append(f"| {name} | {share:.2f} | {1e-6 * num_rays / seconds:.3f} "
                         f"| {1e-6 * num_accesses / seconds:.2f} |")
    return "\n".join(recording), "\n".join(replaying)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sheaf")
    parser.add_argument("--scene", default=str(ROOT / "scenes" / "dragon.glb"))
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--level", type=int, default=3)
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    width, height = arguments.size.split("x")
    settings = [f"image.width={width}", f"image.height={height}",
                f"render.recursion_level={arguments.level}"]
    print(*tables(arguments.sheaf, arguments.scene, settings, arguments.repeats), sep="\n\n")


if __name__ == "__main__":
    main()
