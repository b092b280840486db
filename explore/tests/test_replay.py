# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps that record each scene once and replay it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pytest
from conftest import Explore

from sheaf_explore.points import Point
from sheaf_explore.recording import mark_replayed, recorded_by, replayable
from sheaf_explore.simulator import Simulator
from sheaf_explore.spec import Source

Write = Callable[[str], Path]
SPEC = """scenes = ["tiny.gltf"]
replay = true
[set]
image = { width = 8, height = 6 }
[[axis]]
key = "ray_cache.heuristic"
values = ["none", "dir", "fastpos"]
[[axis]]
key = "render.recursion_level"
values = [0, 1]
"""


@pytest.fixture
def simulator(sheaf: Path) -> Simulator:
    simulator = Simulator(sheaf)
    if not simulator.records:
        pytest.skip(f"{sheaf} cannot record and replay rays")
    return simulator


def table(explore: Explore, folder: Path) -> pd.DataFrame:
    assert explore("collect", folder).returncode == 0
    return pd.read_csv(folder / "results.csv")


def test_a_replayed_sweep_counts_what_a_live_one_does(
    explore: Explore, simulator: Simulator, tiny_scene: Path, tmp_path: Path
) -> None:
    for name, text in {"replayed": SPEC, "live": SPEC.replace("replay = true\n", "")}.items():
        spec = tmp_path / f"{name}.toml"
        spec.write_text(text)
        done = explore("sweep", spec, "--sheaf", simulator.path, "--out", tmp_path / name)
        assert done.returncode == 0, done.stderr
    replayed, live = table(explore, tmp_path / "replayed"), table(explore, tmp_path / "live")
    assert set(replayed["mode"]) == {"replayed"}
    assert set(live["mode"]) == {"live"}
    assert len(list((tmp_path / "replayed/traces/points").iterdir())) == 2
    same = [c for c in live.columns if c not in ("point", "mode")]
    pd.testing.assert_frame_equal(replayed[same], live[same])
    assert explore("report", tmp_path / "replayed").returncode == 0
    page = (tmp_path / "replayed/report/index.html").read_text()
    assert "0 traced their scene live, 6 replayed a recorded trace" in page


def test_a_second_call_records_nothing(
    explore: Explore, simulator: Simulator, tiny_scene: Path, tmp_path: Path
) -> None:
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    words = ["sweep", spec, "--sheaf", simulator.path, "--out", tmp_path / "out"]
    explore(*words)
    journal = (tmp_path / "out/traces/journal.jsonl").read_bytes()
    spec.write_text(SPEC.replace('"fastpos"', '"fastpos", "mdir(24)"'))
    assert explore(*words).returncode == 0
    assert (tmp_path / "out/traces/journal.jsonl").read_bytes() == journal


def test_points_share_a_recording_if_they_differ_in_the_machine_alone() -> None:
    source = Source("scene", Path("a.glb"), "a.glb")

    def point(**settings: int) -> Point:
        return Point(source, {}, {key.replace("__", "."): v for key, v in settings.items()})

    near = point(image__width=8, l2__ways=4)
    other = point(image__width=8, l2__ways=8)
    alone = point(image__width=16, l2__ways=8)
    trace = Point(Source("trace", Path("a.trace"), "a.trace"), {}, {})
    modes = [p.mode for p in mark_replayed([near, other, alone, trace])]
    assert modes == ["replayed", "replayed", "live", "replayed"]
    assert recorded_by(near) == recorded_by(other)
    assert replayable(near.settings) == {"l2.ways": 4}


def test_points_with_heat_maps_are_traced_live() -> None:
    scene = Source("scene", Path("a.glb"), "a.glb")
    settings = [{"image.heat_maps": "rays", "l2.ways": ways} for ways in (4, 8)]
    points = [Point(scene, {}, each) for each in settings]
    assert [p.mode for p in mark_replayed(points)] == ["live", "live"]


def test_a_simulator_that_cannot_record_is_told_with_file_and_line(
    explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    spec = write_spec('scenes = ["scene.glb"]\nreplay = true\n')
    done = explore("sweep", spec, "--sheaf", stand_in.path, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert f"{spec}:2: " in done.stderr
    assert "cannot record" in done.stderr
