# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A cluster of separate processes, joined by address; its workers do not have this package."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from conftest import Explore

from sheaf_explore.simulator import Simulator

Write = Callable[[str], Path]
SPEC = """scenes = ["scene.glb"]
[[axis]]
key = "l2.ways"
range = "1..30"
"""


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[Path, list[subprocess.Popen[bytes]]]]:
    """A scheduler and two workers on loopback; gives the scheduler's file and the workers."""
    shadow = tmp_path / "shadow" / "sheaf_explore"
    shadow.mkdir(parents=True)
    (shadow / "__init__.py").write_text("raise ImportError('not installed on this worker')\n")
    environment = os.environ | {"PYTHONPATH": str(shadow.parent)}
    file = tmp_path / "scheduler.json"
    scheduler = ["dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    worker = ["dask_worker", "--nthreads", "1", "--no-dashboard", "--memory-limit", "0"]
    commands = [scheduler, worker, worker]
    processes = []
    try:
        for command in commands:
            words = [sys.executable, "-m", f"distributed.cli.{command[0]}", *command[1:]]
            words += ["--scheduler-file", str(file)]
            processes.append(
                subprocess.Popen(
                    words,
                    env=environment,
                    cwd=tmp_path,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                )
            )
            deadline = time.monotonic() + 60
            while not file.exists():
                assert time.monotonic() < deadline and processes[0].poll() is None
                time.sleep(0.05)
        yield file, processes[1:]
    finally:
        for process in reversed(processes):
            process.kill()
            process.wait()


def address_in(file: Path) -> str:
    return str(json.loads(file.read_text())["address"])


def test_points_run_on_a_cluster_joined_by_address_or_file(
    explore: Explore,
    write_spec: Write,
    stand_in: Simulator,
    tmp_path: Path,
    cluster: tuple[Path, list[subprocess.Popen[bytes]]],
) -> None:
    file, _ = cluster
    spec = write_spec(SPEC)
    words = ["sweep", spec, "--sheaf", stand_in.path]
    by_address = explore(*words, "--out", tmp_path / "a", "--scheduler", address_in(file))
    assert by_address.returncode == 0, by_address.stderr
    by_file = explore(*words, "--out", tmp_path / "b", "--scheduler-file", file)
    assert by_file.returncode == 0, by_file.stderr
    for folder in ("a", "b"):
        assert len(list((tmp_path / folder / "points").iterdir())) == 30


def test_a_worker_that_dies_takes_no_point_with_it(
    write_spec: Write,
    stand_in: Simulator,
    tmp_path: Path,
    cluster: tuple[Path, list[subprocess.Popen[bytes]]],
) -> None:
    file, workers = cluster
    spec = write_spec(SPEC.replace("[[", "[set]\ndram.latency = 18\n[[", 1))
    words = ["sweep", spec, "--sheaf", stand_in.path, "--out", tmp_path / "out"]
    command = [sys.executable, "-m", "sheaf_explore", *map(str, words)]
    with subprocess.Popen(
        [*command, "--scheduler-file", str(file)], stderr=subprocess.PIPE, text=True
    ) as process:
        deadline = time.monotonic() + 60
        while len(list((tmp_path / "out").glob("points/*"))) < 5:
            assert time.monotonic() < deadline
            time.sleep(0.01)
        workers[0].kill()
        _, errors = process.communicate(timeout=60)
    assert process.returncode == 0, errors
    assert len(list((tmp_path / "out/points").iterdir())) == 30


def test_a_scheduler_that_is_not_there_is_told(
    explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    spec = write_spec(SPEC)
    words = ["sweep", spec, "--sheaf", stand_in.path, "--out", tmp_path / "out"]
    done = explore(*words, "--scheduler", "tcp://127.0.0.1:1")
    assert done.returncode == 3
    assert "no Dask scheduler there" in done.stderr
