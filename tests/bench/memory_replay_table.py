#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""How far replays of a memory trace are from live runs: one trace a scene and kind of flow control,
recorded on the default machine, replayed elastically on twelve other memories, each beside a live
run. Prints a table in Markdown; every number is deterministic.

    tests/bench/memory_replay_table.py build/release/sheaf [--size 128x96] > table.md
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

SCENES = ("dragon", "sponza", "oldtree")
RECORDED = (("tile", "dir"), ("credits", "dir"))
MEMORIES = (
    ("dram.latency=20",),
    ("dram.latency=300",),
    ("dram.latency=1000", "dram.bytes_per_cycle=4"),
    ("dram.bytes_per_cycle=2",),
    ("dram.model=DDR4-2400",),
    ("dram.model=HBM2-2000", "dram.page=closed"),
    ("l2.mode=absent",),
    ("l2.mode=perfect",),
    ("l2.capacity=32KiB", "l2.ways=2"),
    ("node_cache.capacity=2KiB", "triangle_cache.capacity=2KiB"),
    ("node_cache.line=32", "triangle_cache.capacity=64KiB", "triangle_cache.ways=16"),
    ("node_cache.mshrs=1", "triangle_cache.mshrs=1", "l2.mshrs=2"),
)


def sheaf(binary, *arguments):
    subprocess.run([binary, *map(str, arguments), "--quiet"], check=True)


def settings(values):
    return [word for value in values for word in ("--set", value)]


def cycles(folder):
    return json.loads((folder / "stats.json").read_text())["system.cycles"]["value"]


def measure(binary, scene, recorded, size, folder):
    """Live cycles and error of the elastic and the fixed replay, for the recorded machine and then
    for each memory."""
    machine = (f"image.width={size[0]}", f"image.height={size[1]}", f"flow.control={recorded[0]}",
               f"ray_cache.heuristic={recorded[1]}")
    trace = folder / "recorded" / "memory.trace"
    sheaf(binary, "run", scene, *settings(machine), "--record", "memory", "--out", trace.parent)
    rows = []
    for memory in ((), *MEMORIES):
        live = folder / "live"
        sheaf(binary, "run", scene, *settings(machine + memory), "--out", live)
        errors = []
        for mode in ("elastic", "fixed"):
            out = folder / mode
            sheaf(binary, "replay", trace, "--mode", mode, *settings(memory), "--out", out)
            errors.append(100 * (cycles(out) / cycles(live) - 1))
        rows.append((memory, cycles(live), *errors))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sheaf")
    parser.add_argument("--size", default="128x96")
    parser.add_argument("--scenes", nargs="*", default=SCENES)
    options = parser.parse_args()
    size = tuple(int(number) for number in options.size.split("x"))
    root = pathlib.Path(__file__).resolve().parents[2]
    columns = {}
    with tempfile.TemporaryDirectory() as scratch:
        for scene in options.scenes:
            for recorded in RECORDED:
                columns[(scene, *recorded)] = measure(
                    options.sheaf, root / f"scenes/{scene}.glb", recorded, size,
                    pathlib.Path(scratch))
    names = [f"{scene}, {flow}" for scene, flow, _ in columns]
    print("| memory | " + " | ".join(names) + " |")
    print("| --- |" + " --- |" * len(names))
    for i, memory in enumerate(((), *MEMORIES)):
        cells = [f"{rows[i][2]:+.2f} %" for rows in columns.values()]
        name = "as recorded" if not memory else ", ".join(f"`{value}`" for value in memory)
        print(f"| {name} | " + " | ".join(cells) + " |")
    for name, column in (("median of twelve, elastic", 2), ("the same, fixed", 3)):
        medians = [statistics.median(abs(row[column]) for row in rows[1:])
                   for rows in columns.values()]
        print(f"| {name} | " + " | ".join(f"{median:.2f} %" for median in medians) + " |")


if __name__ == "__main__":
    main()
