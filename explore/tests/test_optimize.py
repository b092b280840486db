# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The search for a Pareto front, on a stand-in whose front is known."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import Explore

from sheaf_explore.analysis import pareto_front
from sheaf_explore.simulator import Simulator

# The stand-in makes cycles = 10 · latency + ways and DRAM bytes = 9999 // ways.
SPEC = """scenes = ["scene.glb"]
drop = ["l2.ways == 3"]
[[axis]]
key = "l2.ways"
range = "1..6"
[[axis]]
key = "dram.latency"
values = [20, 30, 40, 50]
[optimize]
minimize = ["system.cycles", "derived.dram_bytes"]
budget = 28
batch = 4
seed = 2
[[optimize.fidelity]]
name = "quick"
share = 3
set = { image.width = 32 }
[[optimize.fidelity]]
name = "full"
share = 1
"""

Write = Callable[[str], Path]


@pytest.fixture
def search(explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path) -> Explore:
    def run(text: str, *words: object):  # type: ignore[no-untyped-def]
        out = tmp_path / "out"
        return explore(
            "optimize", write_spec(text), "--sheaf", stand_in.path, "--out", out, "-j", 2, *words
        )

    return run


def test_the_front_is_found_within_the_budget(
    search: Explore, stand_in: Simulator, tmp_path: Path
) -> None:
    done = search(SPEC)
    assert done.returncode == 0, done.stderr
    starts = len((stand_in.path.parent / "starts").read_text().splitlines())
    assert starts <= 28
    front = json.loads((tmp_path / "out/front.json").read_text())
    machines = {(m["machine"]["l2.ways"], m["machine"]["dram.latency"]) for m in front}
    assert machines == {(str(ways), "20") for ways in (1, 2, 4, 5, 6)}
    values = np.array([list(m["values"].values()) for m in front])
    assert pareto_front(values).all()


def test_a_search_repeats_and_resumes_without_running_anything_again(
    search: Explore, stand_in: Simulator, tmp_path: Path
) -> None:
    search(SPEC)
    first = (tmp_path / "out/front.json").read_bytes()
    starts = (stand_in.path.parent / "starts").read_text()
    assert search(SPEC).returncode == 0
    assert (tmp_path / "out/front.json").read_bytes() == first
    assert (stand_in.path.parent / "starts").read_text() == starts


def test_the_confirmed_machines_are_a_sweep_to_report(search: Explore, tmp_path: Path) -> None:
    search(SPEC)
    sweep = json.loads((tmp_path / "out/sweep.json").read_text())
    assert sweep["points"]
    assert all("image.width" not in point["settings"] for point in sweep["points"])


def test_an_objective_that_no_run_has_is_refused(search: Explore) -> None:
    done = search(SPEC.replace("system.cycles", "system.cycle"))
    assert done.returncode == 2
    assert "'system.cycle'" in done.stderr
