# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Points as work of Slurm jobs, one of which is cancelled midway."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Explore
from slurm_node import jobs, missing, running_slurm

from sheaf_explore.cluster import read_profile
from sheaf_explore.errors import ExploreError
from sheaf_explore.simulator import Simulator

POINTS = 50
PROFILE = """jobs = 2
cores = 1
processes = 1
memory = "1GiB"
walltime = "00:10:00"
interface = "lo"
job_directives_skip = ["--mem"]
"""
SPEC = """scenes = ["scene.glb"]
[set]
dram.latency = 18
[[axis]]
key = "l2.ways"
range = "1..50"
"""
Write = Callable[[str], Path]


@pytest.mark.slurm
@pytest.mark.skipif(bool(missing()), reason=f"Slurm cannot run here: {missing()}")
def test_all_points_finish_though_a_job_is_cancelled(
    write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    spec = write_spec(SPEC)
    folder = tmp_path / "slurm"
    folder.mkdir()
    profile = folder / "profile.toml"
    profile.write_text(PROFILE + f'log_directory = "{folder}"\nlocal_directory = "{folder}"\n')
    out = tmp_path / "out"
    words = ["sweep", spec, "--sheaf", stand_in.path, "--out", out, "--slurm", profile]
    command = [sys.executable, "-m", "sheaf_explore", *map(str, words)]
    with running_slurm(folder) as environment:
        process = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
        try:
            deadline = time.monotonic() + 120
            while len(list(out.glob("points/*"))) < POINTS // 3:
                assert process.poll() is None, process.communicate()[1]
                assert time.monotonic() < deadline, jobs(environment, "all")
                time.sleep(0.05)
            running = jobs(environment)
            assert running, "the points did not run as Slurm jobs"
            subprocess.run(["scancel", running[0]], env=environment, check=True)
            _, errors = process.communicate(timeout=120)
        finally:
            process.kill()
            process.wait()
    assert process.returncode == 0, errors
    assert len(list((out / "points").iterdir())) == POINTS
    ids = (stand_in.path.parent / "starts").read_text().split()
    assert POINTS <= len(ids) <= POINTS + 2  # what the cancelled job had begun ran again


@pytest.mark.parametrize("text", ["cores = 1\n", "jobs = 0\n", "jobs = true\n", "jobs = ["])
def test_a_profile_without_sense_is_refused_with_its_place(tmp_path: Path, text: str) -> None:
    path = tmp_path / "profile.toml"
    path.write_text(text)
    with pytest.raises(ExploreError, match=r"profile\.toml: "):
        read_profile(path)


def test_only_one_cluster_can_be_chosen(
    explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    words = ["sweep", write_spec(SPEC), "--sheaf", stand_in.path, "--out", tmp_path / "out"]
    done = explore(*words, "--slurm", "x.toml", "--scheduler", "tcp://127.0.0.1:1")
    assert done.returncode == 2
    assert "only one of" in done.stderr
