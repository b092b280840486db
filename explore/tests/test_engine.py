# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps with a stand-in for the simulator: accounts, failures, limits, resuming, statuses."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Explore, Finished
from scene_maker import tiny_gltf

from sheaf_explore.simulator import Simulator
from sheaf_explore.store import Store
from sheaf_explore.task import Job, run_point

Write = Callable[[str], Path]
HEAD = 'scenes = ["scene.glb"]\n'


def axis(key: str, values: object) -> str:
    return f"[[axis]]\nkey = '{key}'\nvalues = {values}\n"


def starts(simulator: Simulator) -> int:
    path = simulator.path.parent / "starts"
    return len(path.read_text().splitlines()) if path.exists() else 0


@pytest.fixture
def sweep(
    explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> Callable[..., Finished]:
    def run(text: str, *words: object) -> Finished:
        spec = write_spec(HEAD + text)
        out = tmp_path / "out"
        return explore("sweep", spec, "--sheaf", stand_in.path, "--out", out, "-j", 2, *words)

    return run


Sweep = Callable[..., Finished]


def test_every_point_has_one_folder_and_nothing_else_is_left(
    sweep: Sweep, tmp_path: Path, stand_in: Simulator
) -> None:
    done = sweep(axis("l2.ways", list(range(1, 21))))
    assert done.returncode == 0, done.stderr
    assert "20 of 20 points done" in done.stderr
    out = tmp_path / "out"
    names = {entry["id"] for entry in Store(out).sweep()["points"]}
    assert {path.name for path in (out / "points").iterdir()} == names
    assert not list((out / "work").iterdir())
    assert not (out / "failures").exists()
    assert starts(stand_in) == 20


def test_a_second_call_runs_nothing(sweep: Sweep, stand_in: Simulator) -> None:
    sweep(axis("l2.ways", [1, 2, 3]))
    done = sweep(axis("l2.ways", [1, 2, 3]))
    assert done.returncode == 0
    assert "3 of them before" in done.stderr
    assert starts(stand_in) == 3


def test_a_wider_spec_runs_only_what_is_new(sweep: Sweep, stand_in: Simulator) -> None:
    sweep(axis("l2.ways", [1, 2, 3]))
    assert sweep(axis("l2.ways", [1, 2, 3, 4])).returncode == 0
    assert starts(stand_in) == 4


def test_failures_are_told_kept_and_do_not_stop_the_others(
    sweep: Sweep, tmp_path: Path, stand_in: Simulator
) -> None:
    text = "[limits]\ntime = '0.5s'\nretries = 1\n" + axis("dram.latency", [10, 13, 14, 15, 17, 19])
    done = sweep(text)
    assert done.returncode == 1
    failures = [json.loads(p.read_text()) for p in (tmp_path / "out/failures").iterdir()]
    kinds = {f["point"]["settings"]["dram.latency"]: (f["kind"], f["message"]) for f in failures}
    assert kinds == {
        13: ("refused", "configuration refused: dram.latency = 13 is bad luck"),
        14: ("signal", "ended by SIGKILL; out of memory?"),
        15: ("timeout", "took longer than the limit of 0.5 s"),
        17: ("refused", "ended without a result: no message"),
    }
    assert "dram.latency=13): configuration refused: dram.latency = 13 is bad luck" in done.stderr
    assert "2 of 6 points done; 4 failed" in done.stderr
    assert starts(stand_in) == 7  # only the signal is tried again


def test_a_refusal_is_remembered_and_other_failures_are_tried_again(
    sweep: Sweep, stand_in: Simulator
) -> None:
    text = "[limits]\nretries = 0\n" + axis("dram.latency", [13, 14])
    sweep(text)
    done = sweep(text)
    assert done.returncode == 1
    assert "failed before" in done.stderr
    assert starts(stand_in) == 3


def test_a_point_out_of_memory_fails_and_is_tried_again(
    explore: Explore, sheaf: Path, tiny_scene: Path, tmp_path: Path
) -> None:
    spec = tmp_path / "spec.toml"
    text = 'scenes = ["tiny.gltf"]\n[set]\nimage = { width = 2048, height = 2048 }\n'
    spec.write_text(text + '[limits]\nmemory = "100MiB"\nretries = 0\n')
    for _ in range(2):
        done = explore("sweep", spec, "--sheaf", sheaf, "--out", tmp_path / "out")
        assert done.returncode == 1
        assert "out of memory" in done.stderr
    assert [r["kind"] for r in Store(tmp_path / "out").journal()] == ["memory", "memory"]


def test_a_scene_that_needs_more_memory_runs_once_the_limit_is_raised(
    explore: Explore, sheaf: Path, tmp_path: Path
) -> None:
    document = json.loads(tiny_gltf())
    [mesh] = document["meshes"]
    mesh["primitives"] *= 400
    document["nodes"] = [{"mesh": 0, "scale": [1 + i, 1, 1]} for i in range(400)]
    document["scenes"] = [{"nodes": list(range(400))}]
    (tmp_path / "large.gltf").write_text(json.dumps(document))
    spec = tmp_path / "spec.toml"
    text = 'scenes = ["large.gltf"]\n[set]\nimage = { width = 1, height = 1 }\n'
    text += "render.recursion_level = 0\nkdtree.max_depth = 1\n"
    for limit, status in (("60MiB", 1), ("4GiB", 0)):
        spec.write_text(text + f'[limits]\nmemory = "{limit}"\n')
        done = explore("sweep", spec, "--sheaf", sheaf, "--out", tmp_path / "out")
        assert done.returncode == status, done.stderr
        assert ("large.gltf: out of memory" in done.stderr) == (status == 1)
    assert [r["kind"] for r in Store(tmp_path / "out").journal()] == ["memory", "done"]


def test_what_fails_for_want_of_room_or_a_library_is_tried_again(
    sweep: Sweep, stand_in: Simulator
) -> None:
    text = axis("dram.latency", [31, 32])
    for starts_so_far in (2, 4):
        done = sweep(text)
        assert "result not written: out: no space left" in done.stderr
        assert starts(stand_in) == starts_so_far


def test_a_simulator_that_cannot_be_watched_is_ended(
    stand_in: Simulator, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started = []

    def no_handle(pid: int) -> int:
        started.append(pid)
        raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))

    monkeypatch.setattr(os, "pidfd_open", no_handle)
    words = (str(stand_in.path), "run", "dram.latency=15")
    outcome = run_point(Job("one", str(tmp_path / "out"), words, "{}", False, None, None))
    assert (outcome.kind, outcome.message) == ("failed", "cannot be watched: Too many open files")
    with pytest.raises(ProcessLookupError):  # so it was waited for, too
        os.kill(started[0], 0)


def test_a_crash_is_tried_again_and_can_succeed(sweep: Sweep, stand_in: Simulator) -> None:
    done = sweep(axis("dram.latency", [16]))
    assert done.returncode == 0
    assert "trying again" in done.stderr
    assert starts(stand_in) == 2


def test_a_dry_run_lists_points_and_keeps_its_probes(sweep: Sweep, stand_in: Simulator) -> None:
    done = sweep(axis("l2.ways", list(range(1, 11))), "--dry-run", "--probes", 3)
    assert done.returncode == 0
    assert done.stdout.count("to do") == 10
    assert "7 points left" in done.stderr
    assert starts(stand_in) == 3
    assert sweep(axis("l2.ways", list(range(1, 11)))).returncode == 0
    assert starts(stand_in) == 10


def test_a_folder_of_something_else_is_not_touched(sweep: Sweep, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out/thesis.txt").write_text("mine")
    done = sweep(axis("l2.ways", [1]))
    assert done.returncode == 4
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["thesis.txt"]


def processes_with(word: str) -> list[int]:
    """Processes whose command line has this word."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if word.encode() in path.read_bytes():
                found.append(int(path.parent.name))
        except OSError:
            continue
    return [pid for pid in found if pid != os.getpid()]


@pytest.fixture
def hears_interrupts() -> Iterator[None]:
    """Children hear Ctrl-C even where the tests run in the background, which ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("hears_interrupts")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_sweep_stops_at_once_and_resumes(
    sweep: Sweep, write_spec: Write, stand_in: Simulator, tmp_path: Path, number: signal.Signals
) -> None:
    text = axis("dram.latency", [15, 20, 21, 22])
    spec = write_spec(HEAD + text)
    words = ["sweep", spec, "--sheaf", stand_in.path, "--out", tmp_path / "out", "-j", "2"]
    command = [sys.executable, "-m", "sheaf_explore", *map(str, words)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 60
        while len(list((tmp_path / "out").glob("points/*"))) < 3:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        process.send_signal(number)
        _, errors = process.communicate(timeout=30)
    assert process.returncode == 130, errors
    assert "3 of 4 points done; interrupted: the same command resumes" in errors
    assert not processes_with(str(tmp_path / "out"))
    text = text.replace("15, ", "")
    assert sweep(text).returncode == 0
    assert starts(stand_in) == 4


def test_two_sweeps_cannot_use_one_folder(
    sweep: Sweep, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    store = Store(tmp_path / "out")
    with store.opened():
        done = sweep(axis("l2.ways", [1]))
    assert done.returncode == 2
    assert "another sweep is running here" in done.stderr
