# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Where a sweep runs: threads of this process, worker processes, any Dask cluster, or Slurm."""

from __future__ import annotations

import contextlib
import logging
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import dask
from distributed import Client, LocalCluster

from sheaf_explore.errors import Exit, ExploreError

# A worker that dies takes the point it runs with it, which is then tried elsewhere. With Dask's
# usual three deaths a point, killing workers at random would soon give up on innocent ones.
_ALLOWED_DEATHS = 20


@dataclass(frozen=True)
class ClusterChoice:
    """How to get workers; at most one of scheduler, scheduler_file and slurm is given."""

    workers: int
    processes: bool = False
    scheduler: str | None = None
    scheduler_file: Path | None = None
    slurm: Path | None = None


@contextlib.contextmanager
def open_cluster(choice: ClusterChoice) -> Iterator[Client]:
    """A client of the chosen cluster; what was started here is stopped at the end."""
    given = [choice.scheduler, choice.scheduler_file, choice.slurm]
    if sum(x is not None for x in given) > 1:
        raise ExploreError("give only one of --scheduler, --scheduler-file and --slurm")
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    settings = {
        "distributed.scheduler.allowed-failures": _ALLOWED_DEATHS,
        "distributed.worker.multiprocessing-method": "spawn",
        "distributed.worker.profile.enabled": False,
        "distributed.admin.tick.interval": "1s",
        "distributed.admin.tick.limit": "1h",
    }
    with dask.config.set(settings):
        if choice.scheduler is not None or choice.scheduler_file is not None:
            client = _join(choice)
            with client:
                yield client
        elif choice.slurm is not None:
            with _slurm(choice) as cluster, Client(cluster) as client:
                yield client
        else:
            with _local(choice) as cluster, Client(cluster) as client:
                yield client


def _local(choice: ClusterChoice) -> LocalCluster:
    return LocalCluster(
        n_workers=choice.workers if choice.processes else 1,
        threads_per_worker=1 if choice.processes else choice.workers,
        processes=choice.processes,
        memory_limit=0,  # simulators are processes of their own
        dashboard_address="127.0.0.1:0",
        worker_dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
    )


def _join(choice: ClusterChoice) -> Client:
    place = choice.scheduler or str(choice.scheduler_file)
    try:
        if choice.scheduler_file is not None:
            if not choice.scheduler_file.is_file():
                raise ExploreError(f"{place}: no such scheduler file", Exit.CLUSTER)
            return Client(scheduler_file=str(choice.scheduler_file), timeout="10s")
        return Client(choice.scheduler, timeout="10s")
    except (OSError, TimeoutError, ValueError) as error:
        reason = str(error) or "no answer"
        raise ExploreError(f"{place}: no Dask scheduler there: {reason}", Exit.CLUSTER) from None


def read_profile(path: Path) -> dict[str, Any]:
    """Reads a Slurm profile: `jobs`, and whatever dask_jobqueue.SLURMCluster takes."""
    try:
        profile = tomllib.loads(path.read_text())
    except OSError as error:
        raise ExploreError(f"{path}: cannot be read: {error.strerror}") from None
    except tomllib.TOMLDecodeError as error:
        raise ExploreError(f"{path}: {error}") from None
    jobs = profile.get("jobs")
    if not isinstance(jobs, int) or isinstance(jobs, bool) or jobs < 1:
        raise ExploreError(f"{path}: needs jobs = N, how many Slurm jobs to keep running")
    for key, value in {"cores": 1, "processes": 1, "memory": "2GiB"}.items():
        profile.setdefault(key, value)
    return profile


@contextlib.contextmanager
def _slurm(choice: ClusterChoice) -> Iterator[Any]:
    assert choice.slurm is not None
    profile = read_profile(choice.slurm)
    try:
        from dask_jobqueue import SLURMCluster
    except ImportError:
        remedy = "pip install 'sheaf-explore[slurm]'"
        raise ExploreError(f"--slurm needs dask-jobqueue: {remedy}") from None
    jobs = profile.pop("jobs")
    try:
        cluster = SLURMCluster(**profile, scheduler_options={"dashboard_address": ":0"})
    except (TypeError, ValueError) as error:
        raise ExploreError(f"{choice.slurm}: {error}") from None
    with cluster:
        # Adaptive rather than scaled once: a job that Slurm ends is replaced.
        cluster.adapt(minimum_jobs=jobs, maximum_jobs=jobs)
        yield cluster
