# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Measures the engine on an idle machine; no test, because it measures time. Run it by hand:

    build/venv/bin/python explore/tests/bench_engine.py build/release/sheaf

Prints what a point costs beyond its simulator, and the throughput of two workers against one.
"""

from __future__ import annotations

import json
import resource
import sys
import tempfile
import time
from pathlib import Path

from scene_maker import tiny_gltf

from sheaf_explore.cluster import ClusterChoice, open_cluster
from sheaf_explore.engine import Engine
from sheaf_explore.simulator import Simulator
from sheaf_explore.store import Store
from sheaf_explore.sweep import load_spec, plan_sweep
from sheaf_explore.task import Job, Outcome

POINTS = 300
SPEC = """scenes = ["tiny.gltf"]
[set]
image = {{ width = {width}, height = {width} }}
[[axis]]
key = "dram.latency"
range = "1..{points}"
"""


class Silent:
    """Watches nothing."""

    def finished(self, outcome: Outcome) -> None: ...

    def retrying(self, outcome: Outcome, attempt: int) -> None: ...

    def workers(self, threads: int) -> None: ...


def cpu(who: int) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def measure(jobs: list[Job], store: Store, workers: int) -> dict[str, float]:
    """Runs all jobs; seconds a point of wall time, of this process, and of the simulators."""
    with open_cluster(ClusterChoice(workers)) as client:
        engine = Engine(client, store, 0, Silent())
        own, theirs = cpu(resource.RUSAGE_SELF), cpu(resource.RUSAGE_CHILDREN)
        started = time.monotonic()
        tally = engine.run(jobs)
        wall = time.monotonic() - started
    assert tally.done == len(jobs), tally
    own = cpu(resource.RUSAGE_SELF) - own
    theirs = cpu(resource.RUSAGE_CHILDREN) - theirs
    n = len(jobs)
    return {
        "points": n,
        "workers": workers,
        "wall_ms": 1e3 * wall / n,
        "engine_cpu_ms": 1e3 * own / n,
        "simulator_cpu_ms": 1e3 * theirs / n,
        "beyond_simulator_ms": 1e3 * (wall - sum(tally.seconds) / workers) / n,
    }


def main() -> None:
    simulator = Simulator(Path(sys.argv[1]).resolve())
    for width, points in ((8, POINTS), (512, 40)):
        walls = {}
        for workers in (1, 2):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                (folder / "tiny.gltf").write_text(tiny_gltf())
                path = folder / "spec.toml"
                path.write_text(SPEC.format(width=width, points=points))
                store = Store(folder / "out")
                with store.opened():
                    sweep = plan_sweep(load_spec(path, simulator), simulator, store, folder)
                    result = measure(sweep.jobs(), store, workers)
            walls[workers] = result["wall_ms"]
            print(json.dumps({"width": width} | result))
        print(f"throughput of 2 workers / 1: {walls[1] / walls[2]:.2f}")


if __name__ == "__main__":
    main()
