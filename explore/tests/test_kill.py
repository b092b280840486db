# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""kill -9 at random: a sweep loses nothing, repeats nothing safe, and leaves nothing behind.

The simulator is the real one, behind a script that keeps account of what was started.
"""

from __future__ import annotations

import contextlib
import random
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from conftest import Explore

POINTS = 200

# Notes each start, and each start of a point whose result is safe already. The pause makes it
# likely that a kill hits a run; exec keeps the process number, which --parent is checked against.
WRAPPER = """#!/bin/sh
for word in "$@"; do last=$result; result=$word; [ "$last" = --out ] && break; done
if [ "$last" = --out ]; then
  work=${{result%/result}}; id=${{work##*/}}
  echo "$id" >> "{log}"
  [ -e "${{work%/work/*}}/points/$id/stats.json" ] && echo "$id" >> "{log}.again"
  sleep {pause}
fi
exec "{sheaf}" "$@"
"""

SPEC = """scenes = ["tiny.gltf"]
[limits]
retries = 50
[set]
image = {{ width = 8, height = 6 }}
[[axis]]
key = "dram.latency"
range = "1..{half}"
[[axis]]
key = "ray_cache.heuristic"
values = ["dir", "fastpos"]
"""


def wrapper(folder: Path, sheaf: Path, pause: float) -> Path:
    path = folder / "sheaf"
    path.write_text(WRAPPER.format(sheaf=sheaf, log=folder / "starts", pause=pause))
    path.chmod(0o755)
    return path


@pytest.fixture
def spec(tmp_path: Path, tiny_scene: Path) -> Path:
    assert tiny_scene.parent == tmp_path
    path = tmp_path / "spec.toml"
    path.write_text(SPEC.format(half=POINTS // 2))
    return path


def contents(sweep: Path) -> dict[str, bytes]:
    """Every file of every point; of the summary all but the simulator's wall time."""
    files = {}
    for path in (sweep / "points").rglob("*"):
        if path.is_file():
            data = path.read_bytes()
            if path.name == "summary.txt":
                data = data.partition(b"Wall time")[0]
            files[str(path.relative_to(sweep))] = data
    return files


def alive(word: str) -> list[psutil.Process]:
    """Processes with a word in their command line, this one excepted."""
    found = []
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if process.status() != psutil.STATUS_ZOMBIE and any(
                word in part for part in process.cmdline()
            ):
                found.append(process)
    return found


def wait_until_gone(word: str) -> None:
    deadline = time.monotonic() + 15
    while left := alive(word):
        assert time.monotonic() < deadline, [p.cmdline() for p in left]
        time.sleep(0.05)


class Driver:
    """A sweep as a process of its own, with two workers: processes or threads."""

    def __init__(self, spec: Path, sheaf: Path, out: Path, processes: bool = True) -> None:
        words = ["sweep", spec, "--sheaf", sheaf, "--out", out, "-j", 2]
        words += ["--processes"] if processes else []
        command = [sys.executable, "-m", "sheaf_explore", *map(str, words)]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)

    def children(self) -> Iterator[psutil.Process]:
        with contextlib.suppress(psutil.Error):
            yield from psutil.Process(self.process.pid).children(recursive=True)

    def workers(self) -> list[psutil.Process]:
        return [p for p in self.children() if "spawn_main" in " ".join(_command(p))]

    def simulators(self) -> list[psutil.Process]:
        return [p for p in self.children() if "--out" in _command(p)]

    def kill_all(self) -> list[psutil.Process]:
        """Kills the sweep itself; gives what has to end by itself."""
        children = list(self.children())
        self.process.kill()
        self.process.communicate(timeout=30)
        return children


def _command(process: psutil.Process) -> list[str]:
    try:
        return process.cmdline()
    except psutil.Error:
        return []


def disturb(driver: Driver, what: str) -> bool:
    """Kills one simulator, one worker or the sweep; false if it ended first."""
    if driver.process.poll() is not None:
        return False
    if what == "sweep":
        _, left = psutil.wait_procs(driver.kill_all(), timeout=15)
        assert not left, "processes outlived their sweep"
        return True
    while driver.process.poll() is None:
        victims = driver.simulators() if what == "simulator" else driver.workers()
        for victim in victims[:1]:
            with contextlib.suppress(psutil.Error):
                victim.kill()
                return True
        time.sleep(0.01)
    return False


@pytest.mark.parametrize("seed", [1, 2])
def test_kills_at_random_lose_nothing_and_repeat_nothing(
    explore: Explore, spec: Path, sheaf: Path, tmp_path: Path, seed: int
) -> None:
    generator = random.Random(seed)
    program = wrapper(tmp_path, sheaf, pause=0.05)
    out = tmp_path / "killed"
    kills = [*["simulator"] * 4, *["worker"] * 2, *["sweep"] * 3]
    generator.shuffle(kills)
    driver = Driver(spec, program, out)
    try:
        for what in kills:
            done_before = len(list(out.glob("points/*")))
            deadline = time.monotonic() + 60
            wanted = done_before + generator.randrange(2, 12)
            while driver.process.poll() is None and len(list(out.glob("points/*"))) < wanted:
                assert time.monotonic() < deadline, "the sweep stands still"
                time.sleep(0.01)
            time.sleep(generator.random() * 0.1)
            if not disturb(driver, what):
                pytest.fail(f"ended before it was killed: {driver.process.communicate()[1]}")
            if what == "sweep":
                driver = Driver(spec, program, out)
        assert driver.process.poll() is None, "the sweep was over before the last kill"
        _, errors = driver.process.communicate(timeout=120)
        assert driver.process.returncode == 0, errors
        assert f"{POINTS} of {POINTS} points done" in errors
    finally:
        if driver.process.poll() is None:
            driver.kill_all()
    wait_until_gone(str(tmp_path))
    assert not (tmp_path / "starts.again").exists()
    assert not list((out / "work").iterdir())

    calm = tmp_path / "calm"
    assert explore("sweep", spec, "--sheaf", program, "--out", calm, "-j", 2).returncode == 0
    assert contents(out) == contents(calm)
    assert len(list((out / "points").iterdir())) == POINTS
    for folder in (out, calm):
        assert explore("collect", folder).returncode == 0
    for name in ("results.csv", "results.parquet", "columns.csv"):
        assert (out / name).read_bytes() == (calm / name).read_bytes()


def test_a_simulator_ends_with_the_process_that_started_it(
    sheaf: Path, tiny_scene: Path, tmp_path: Path
) -> None:
    code = (
        "import os, subprocess, sys, time\n"
        "subprocess.Popen([*sys.argv[1:], '--parent', str(os.getpid())])\n"
        "time.sleep(60)\n"
    )
    run = [sheaf, "run", tiny_scene, "--out", tmp_path / "out", "--set", "image.width=16384"]
    run += ["--set", "image.height=16384"]
    with subprocess.Popen([sys.executable, "-c", code, *map(str, run)]) as parent:
        deadline = time.monotonic() + 30
        while not (tmp_path / "out").exists():
            assert time.monotonic() < deadline
            time.sleep(0.05)
        parent.kill()
    wait_until_gone(str(tmp_path))


def test_a_run_whose_parent_is_gone_does_not_begin(
    sheaf: Path, tiny_scene: Path, tmp_path: Path
) -> None:
    done = subprocess.run(
        [sheaf, "run", tiny_scene, "--out", tmp_path / "out", "--parent", "1"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "--parent 1" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("processes", [True, False])
def test_a_long_run_ends_with_its_killed_sweep(
    sheaf: Path, tiny_scene: Path, tmp_path: Path, processes: bool
) -> None:
    spec = tmp_path / "spec.toml"
    spec.write_text('scenes = ["tiny.gltf"]\n[set]\nimage = { width = 16384, height = 16384 }\n')
    driver = Driver(spec, sheaf, tmp_path / "out", processes)
    try:
        deadline = time.monotonic() + 60
        while not driver.simulators():
            assert time.monotonic() < deadline and driver.process.poll() is None
            time.sleep(0.05)
        simulator = driver.simulators()[0]
        assert simulator.is_running()
    finally:
        _, left = psutil.wait_procs(driver.kill_all(), timeout=15)
    for process in left:
        process.kill()
    assert not left, "processes outlived their sweep"
