# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Sends the points of a sweep to workers and keeps account of what became of each."""

from __future__ import annotations

import contextlib
import dataclasses
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Protocol

import cloudpickle
from distributed import as_completed, CancelledError, Client
from distributed.scheduler import KilledWorker

from sheaf_explore import task
from sheaf_explore.errors import Exit, ExploreError
from sheaf_explore.store import Store
from sheaf_explore.task import Job, Outcome

_RETRIED = ("signal", "cancelled")
_MOST_ATTEMPTS = 1000  # that a point is given while workers come and go
_WINDOW_A_THREAD = 8
_SMALLEST_WINDOW = 64
_SECONDS_BETWEEN_COUNTS = 1.0


class Watcher(Protocol):
    """Is told as points finish."""

    def finished(self, outcome: Outcome) -> None: ...

    def retrying(self, outcome: Outcome, attempt: int) -> None: ...

    def workers(self, threads: int) -> None: ...


@dataclass
class Tally:
    """What became of the points of one call."""

    done: int = 0
    failed: list[Outcome] = field(default_factory=list)
    interrupted: bool = False
    seconds: list[float] = field(default_factory=list)  # of each simulation that ran


def run_job(job: dict[str, Any]) -> dict[str, Any]:
    """run_on_worker with plain dictionaries, which every worker can read."""
    return dataclasses.asdict(task.run_on_worker(task.Job(**job)))


class _Carried:
    """A function that carries this package's part of it along; pickled once, not once a task."""

    def __init__(self, function: Callable[..., Any]) -> None:
        for module in (task, sys.modules[__name__]):
            cloudpickle.register_pickle_by_value(module)
        self._bytes = cloudpickle.dumps(function)
        for module in (task, sys.modules[__name__]):
            cloudpickle.unregister_pickle_by_value(module)

    def __reduce__(self) -> tuple[Callable[[bytes], Any], tuple[bytes]]:
        return cloudpickle.loads, (self._bytes,)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        raise TypeError("is only to be sent to workers")


@contextlib.contextmanager
def _terminate_like_interrupt() -> Iterator[None]:
    """SIGTERM ends a sweep as Ctrl-C does."""

    def interrupt(_number: int, _frame: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class Engine:
    """Runs jobs on a cluster until each is done or has failed for good."""

    def __init__(self, client: Client, store: Store, retries: int, watcher: Watcher) -> None:
        self._client = client
        self._store = store
        self._retries = retries
        self._watcher = watcher
        self._attempts: dict[str, int] = {}
        self._lost: dict[str, int] = {}  # attempts whose worker was lost, by no fault of the point
        self._jobs: dict[str, Job] = {}  # by key of the future
        self._tally = Tally()
        self._run = _Carried(run_job)
        self._threads = 0
        self._threads_asked = -_SECONDS_BETWEEN_COUNTS

    def run(self, jobs: list[Job]) -> Tally:
        """Runs the jobs; on Ctrl-C it stops what runs and tells so in the tally."""
        self._tally = Tally()
        if not jobs:
            return self._tally
        self._tell_workers_to_stop(False)
        try:
            with _terminate_like_interrupt():
                self._drive(deque(jobs))
        except KeyboardInterrupt:
            self._tally.interrupted = True
            self._abandon()
        return self._tally

    def _drive(self, waiting: deque[Job]) -> None:
        completed = as_completed(with_results=False)
        running = 0
        while waiting or running:
            window = max(_SMALLEST_WINDOW, _WINDOW_A_THREAD * self._count_threads())
            while waiting and running < window:
                completed.add(self._submit(waiting.popleft()))
                running += 1
            for future in _next_batch(completed):
                running -= 1
                again = self._take(future)
                if again is not None:
                    waiting.appendleft(again)

    def _count_threads(self) -> int:
        if time.monotonic() - self._threads_asked > _SECONDS_BETWEEN_COUNTS:
            self._threads = sum(self._client.nthreads().values())
            self._threads_asked = time.monotonic()
            self._watcher.workers(self._threads)
        return self._threads

    def _submit(self, job: Job) -> Any:
        attempt = self._attempts.get(job.id, 0) + 1
        self._attempts[job.id] = attempt
        future = self._client.submit(
            self._run, dataclasses.asdict(job), key=f"sheaf-{job.id}-{attempt}", pure=False
        )
        self._jobs[str(future.key)] = job
        return future

    def _take(self, future: Any) -> Job | None:
        """Settles one finished attempt; gives the job if it is to be tried again."""
        job = self._jobs.pop(future.key)
        outcome = self._outcome(future, job)
        future.release()  # or Dask would compute it anew when its worker dies
        attempt = self._attempts[job.id]
        if outcome.kind == "lost":
            self._lost[job.id] = self._lost.get(job.id, 0) + 1
        own_fault = attempt - self._lost.get(job.id, 0)
        retry = (outcome.kind in _RETRIED and own_fault <= self._retries) or (
            outcome.kind == "lost" and attempt < _MOST_ATTEMPTS
        )
        self._store.record(job, outcome, final=not retry)
        if outcome.fresh:
            self._tally.seconds.append(outcome.seconds)
        if retry:
            self._watcher.retrying(outcome, attempt)
            return job
        if outcome.kind == "done":
            self._tally.done += 1
        else:
            self._tally.failed.append(outcome)
        self._watcher.finished(outcome)
        return None

    def _outcome(self, future: Any, job: Job) -> Outcome:
        if future.status == "finished":
            with contextlib.suppress(CancelledError):
                return Outcome(**future.result())
        if future.status != "error":
            # The answer went down with its worker, or everything with the scheduler. The result of
            # the point may be safe all the same; the next attempt will see.
            if self._client.status != "running":
                raise ExploreError(
                    "the cluster was lost; finished points are safe, run again to resume",
                    Exit.CLUSTER,
                )
            return Outcome(job.id, "lost", "its worker was lost")
        error = future.exception()
        if isinstance(error, KilledWorker):
            return Outcome(job.id, "signal", "every worker that ran it was killed; out of memory?")
        return Outcome(job.id, "worker", f"the worker failed: {error!r}")

    def _abandon(self) -> None:
        """Stops simulators and forgets what waits, as far as the cluster still answers."""
        with contextlib.suppress(Exception):
            self._tell_workers_to_stop(True)
            self._client.cancel([*map(self._client_future, self._jobs)], force=True)

    def _client_future(self, key: str) -> Any:
        from distributed import Future

        return Future(key, self._client)

    def _tell_workers_to_stop(self, stop: bool) -> None:
        self._client.run(_Carried(task.stop_on_worker), str(self._store.folder), stop)


def _next_batch(completed: Any) -> list[Any]:
    """Waits for a finished future, then takes all that are finished."""
    return [next(completed), *completed.next_batch(block=False)]
