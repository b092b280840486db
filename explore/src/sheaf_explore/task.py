# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""One point, as a worker runs it: lock, simulate into a temporary folder, rename.

Only the standard library is used, and nothing else of this package: the whole module is sent to the
workers by value, so that any Dask cluster can run a sweep without having it installed.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import resource
import select
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterator, MutableMapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

COMPLETE_MARK = "stats.json"
_MESSAGE_BYTES = 4000
_EXIT_MEANINGS = {
    0: "ended without a result",
    1: "bug of the simulator",
    2: "configuration refused",
    3: "scene refused",
    4: "result not written",
    5: "machine stuck",
    6: "trace refused",
}


@dataclass(frozen=True)
class Job:
    """A point with all that a worker needs to know."""

    id: str
    folder: str  # of the sweep
    arguments: tuple[str, ...]  # command line without --out
    point: str  # contents of point.json
    ends_with_worker: bool  # the command takes --parent
    seconds: float | None
    memory: int | None


@dataclass(frozen=True)
class Outcome:
    """What became of one attempt; `kind` is done, refused, memory, timeout, signal or cancelled."""

    id: str
    kind: str
    message: str = ""
    code: int = 0
    fresh: bool = False  # a simulator ran for it
    seconds: float = 0.0
    cpu_seconds: float = 0.0
    host: str = ""


def result_folder(sweep: Path, point: str) -> Path:
    """Where the finished result of a point is."""
    return sweep / "points" / point


def is_done(sweep: Path, point: str) -> bool:
    """Whether the result of a point is safe."""
    return (result_folder(sweep, point) / COMPLETE_MARK).exists()


@contextlib.contextmanager
def _locked(path: Path, done: Path) -> Iterator[bool]:
    """Holds the lock of a point; gives False if its result turned up while waiting.

    The kernel gives the lock up when its holder ends, however it ends.
    """
    while True:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            stream = path.open("w")
        except FileNotFoundError:
            continue  # whoever held the lock has just removed the folder
        with stream:
            while not done.exists():
                try:
                    fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    break
                except BlockingIOError:
                    time.sleep(0.05)
            if done.exists():
                yield False
                return
            # The lock counts only if the file is still the one that others will open.
            with contextlib.suppress(FileNotFoundError):
                if path.stat().st_ino == os.fstat(stream.fileno()).st_ino:
                    yield True
                    return


def run_point(job: Job, running: MutableMapping[str, int] | None = None) -> Outcome:
    """Runs one point unless its result is there; never raises for what a simulator does.

    `running` is told the process number while there is one.
    """
    sweep = Path(job.folder)
    mark = result_folder(sweep, job.id) / COMPLETE_MARK
    if mark.exists():
        return Outcome(job.id, "done")
    work = sweep / "work" / job.id
    with _locked(work / "lock", mark) as ours:
        if not ours:
            return Outcome(job.id, "done")
        outcome = _simulate(job, work, {} if running is None else running)
        if outcome.kind == "done":
            _make_safe(job, work / "result")
        shutil.rmtree(work, ignore_errors=True)
        return outcome


def _make_safe(job: Job, result: Path) -> None:
    (result / "point.json").write_text(job.point)
    final = result_folder(Path(job.folder), job.id)
    final.parent.mkdir(exist_ok=True)
    with contextlib.suppress(FileNotFoundError):
        shutil.rmtree(final)  # without a result in it, or this would not run
    result.rename(final)


def _simulate(job: Job, work: Path, running: MutableMapping[str, int]) -> Outcome:
    result = work / "result"
    shutil.rmtree(result, ignore_errors=True)
    words = [*job.arguments, "--out", str(result), "--quiet"]
    if job.ends_with_worker:
        words += ["--parent", str(os.getpid())]
    started = time.monotonic()
    try:
        with (work / "stderr").open("wb") as errors:
            process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                process_group=0,  # Ctrl-C in a terminal is the sweep's to handle
            )
    except OSError as error:
        return Outcome(job.id, "refused", f"{words[0]}: {error.strerror}", 127)
    running[job.id] = process.pid
    try:
        late, usage = _wait(process, job)
    finally:
        running.pop(job.id, None)
    return _judge(job, work, process.returncode, late, time.monotonic() - started, usage)


def _wait(process: subprocess.Popen[bytes], job: Job) -> tuple[bool, resource.struct_rusage]:
    """Waits without polling; kills the process if it takes longer than it may."""
    if job.memory is not None:
        with contextlib.suppress(ProcessLookupError):
            resource.prlimit(process.pid, resource.RLIMIT_AS, (job.memory, job.memory))
    handle = os.pidfd_open(process.pid)
    try:
        poll = select.poll()
        poll.register(handle, select.POLLIN)
        late = not poll.poll(None if job.seconds is None else job.seconds * 1000)
        if late:
            process.kill()
        _, status, usage = os.wait4(process.pid, 0)
    finally:
        os.close(handle)
    process.returncode = os.waitstatus_to_exitcode(status)
    return late, usage


def _judge(
    job: Job, work: Path, code: int, late: bool, seconds: float, usage: resource.struct_rusage
) -> Outcome:
    def outcome(kind: str, message: str = "") -> Outcome:
        cpu = usage.ru_utime + usage.ru_stime
        host = socket.gethostname()
        return Outcome(job.id, kind, message, code, True, seconds, cpu, host)

    if late:
        return outcome("timeout", f"took longer than the limit of {job.seconds:g} s")
    if code < 0:
        name = signal.Signals(-code).name
        hint = "; out of memory?" if -code == signal.SIGKILL else ""
        return outcome("signal", f"ended by {name}{hint}")
    if code == 0 and (work / "result" / COMPLETE_MARK).exists():
        return outcome("done")
    if code == 130:
        return outcome("cancelled", "interrupted")
    said = (work / "stderr").read_bytes()[-_MESSAGE_BYTES:].decode(errors="replace").strip()
    reason = _EXIT_MEANINGS.get(code, f"exit status {code}")
    last = said.splitlines()[-1].removeprefix("sheaf: ") if said else "no message"
    # The simulator refuses what does not fit into memory; with more of it, it would not.
    return outcome("memory" if "out of memory" in last else "refused", f"{reason}: {last}")


def run_on_worker(job: Job) -> Outcome:
    """run_point on a Dask worker, which remembers the process so that it can be cancelled."""
    from distributed import get_worker

    worker: Any = get_worker()
    running = worker.__dict__.setdefault("sheaf_running", {})
    stopped = worker.__dict__.setdefault("sheaf_stopped", set())
    if job.folder in stopped:
        return Outcome(job.id, "cancelled")
    outcome = run_point(job, running)
    if job.folder in stopped and outcome.kind == "signal":
        return Outcome(job.id, "cancelled")
    return outcome


def stop_on_worker(folder: str, stop: bool, dask_worker: Any = None) -> None:
    """Kills what runs of a sweep on this worker; nothing of it begins until allowed again."""
    stopped = dask_worker.__dict__.setdefault("sheaf_stopped", set())
    if not stop:
        stopped.discard(folder)
        return
    stopped.add(folder)
    for pid in list(dask_worker.__dict__.get("sheaf_running", {}).values()):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def failure_text(outcome: Outcome, point: str) -> str:
    """What is kept of a failed point."""
    record = {"kind": outcome.kind, "code": outcome.code, "message": outcome.message}
    return json.dumps(record | {"point": json.loads(point)}, indent=1, sort_keys=True) + "\n"
