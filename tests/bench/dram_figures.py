#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Prints rtl_notes/dram_figures.md: what `sheaf memory` says about a million accesses.

    tests/bench/dram_figures.py build/release/sheaf > rtl_notes/dram_figures.md
"""

import json
import subprocess
import sys

COUNT = 1_000_000
INTRODUCTION = """# DRAM alone, in figures

Made by `tests/bench/dram_figures.py`; each line is one run of

    sheaf memory --set dram.model=MODEL --generate STREAM --gap GAP --count 1000000

of reads of 64 bytes with seed 1, everything else as it is by default. Latency runs from the acceptance into
the queue to the last byte; the wait before a full queue is not in it. With a gap of 0 arrivals are as fast as
they are taken, which gives the bandwidth at saturation.
"""


def measure(sheaf: str, model: str, stream: str, gap: int) -> dict[str, float]:
    command = [sheaf, "memory", "--json", "--set", f"dram.model={model}", "--generate", stream]
    command += ["--gap", str(gap), "--count", str(COUNT)]
    values = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return {name: entry["value"] for name, entry in values.items()}


def row(sheaf: str, model: str, stream: str, gap: int) -> str:
    m = measure(sheaf, model, stream, gap)
    bandwidth, peak = m["memory.bandwidth"], m["memory.peak_bandwidth"]
    return (
        f"| {model} | {stream} | {gap} | {m['memory.read_latency.mean']:.2f} "
        f"| {m['memory.read_latency.p99']} | {m['memory.wait.mean']:.1f} "
        f"| {100 * m['memory.row_hit_rate']:.2f} % "
        f"| {bandwidth / 1e9:.3f} | {100 * bandwidth / peak:.2f} % |"
    )


def main() -> None:
    sheaf = sys.argv[1]
    print(INTRODUCTION)
    print(
        "| model | stream | gap, tCK | mean latency, tCK | 99 %, tCK | mean wait, tCK | row hits "
        "| GB/s | of the peak |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for model in ("DDR4-2400", "DDR4-3200"):
        for stream in ("sequential", "interleaved", "random"):
            for gap in (0, 8, 16, 100):
                print(row(sheaf, model, stream, gap))


if __name__ == "__main__":
    main()
