# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A sweep from its spec to its finished points."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from distributed import Client

from sheaf_explore.cluster import ClusterChoice, open_cluster
from sheaf_explore.engine import Engine, Tally
from sheaf_explore.errors import Exit, ExploreError
from sheaf_explore.points import expand, Point
from sheaf_explore.progress import ProgressWatcher
from sheaf_explore.quantities import format_duration
from sheaf_explore.read_spec import read_spec
from sheaf_explore.recording import mark_replayed, recorded_by, Recordings, replayable
from sheaf_explore.simulator import Simulator
from sheaf_explore.spec import Spec
from sheaf_explore.store import Entry, Store
from sheaf_explore.task import Job
from sheaf_explore.toml_lines import line_of

Say = Callable[[str], None]


def cache_folder() -> Path:
    """Where the simulator keeps scenes and trees that runs share."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "sheaf"


def load_spec(path: Path, simulator: Simulator) -> Spec:
    """Reads a spec and has the simulator check what only it can. Raises ExploreError."""
    spec = read_spec(path, simulator.parameters)
    simulator.check_replay(spec.sources)
    if spec.replay and not simulator.records:
        line = line_of(spec.text, ("replay",))
        raise ExploreError(f"{path}:{line}: {simulator.path} cannot record and replay rays")
    _check_outputs(spec, simulator)
    _check_values(spec, simulator)
    return spec


def _check_outputs(spec: Spec, simulator: Simulator) -> None:
    """A simulator that cannot leave out or write what the spec says is refused."""
    replays = spec.replay or any(source.kind == "trace" for source in spec.sources)
    needed = []
    if not spec.outputs.images:
        needed.append(("images", "run", "--no-images"))
    if spec.outputs.timeline:
        commands = ("run", "replay") if replays else ("run",)
        needed += [("timeline", command, "--timeline") for command in commands]
    for key, command, option in needed:
        if option not in simulator.options(command):
            line = line_of(spec.text, ("outputs", key))
            raise ExploreError(
                f"{spec.path}:{line}: {simulator.path} has no option {option} of `{command}`"
            )


def _check_values(spec: Spec, simulator: Simulator) -> None:
    """Free text, such as the name of a heuristic, only the simulator understands."""
    fixed = {k: v for k, v in spec.settings.items() if simulator.parameters[k].free_text}
    for key, value in fixed.items():
        if refusal := simulator.refusal({key: value}):
            line = line_of(spec.text, ("set", *key.split(".")))
            raise ExploreError(f"{spec.path}:{line}: {refusal}")
    for i, axis in enumerate(spec.axes):
        tried = set()
        for choice in axis.choices:
            for key, value in choice.settings.items():
                if not simulator.parameters[key].free_text or (key, value) in tried:
                    continue
                tried.add((key, value))
                if refusal := simulator.refusal({key: value}):
                    raise ExploreError(f"{spec.path}:{line_of(spec.text, ('axis', i))}: {refusal}")


@dataclass(frozen=True)
class Sweep:
    """A spec with its points, named, in its folder."""

    spec: Spec
    simulator: Simulator
    store: Store
    points: list[Point]
    entries: list[Entry]
    cache: Path

    def jobs(self) -> list[Job]:
        """Work orders of all points that have no result yet."""
        return [
            self.store.job(entry, self.arguments(point), self.spec, self.simulator)
            for entry, point in zip(self.entries, self.points, strict=True)
            if not self.store.is_done(entry.id)
        ]

    def arguments(self, point: Point) -> list[str]:
        """The command line of a point, without its folder."""
        return [*self._simulating(point), *point.output_options()]

    def _simulating(self, point: Point) -> list[str]:
        if not point.from_recording:
            return self.simulator.arguments(point.source, point.settings, self.cache)
        recording = self.recordings.entry(recorded_by(point))
        trace = self.recordings.trace(recording)
        free = replayable(point.settings)
        return self.simulator.replaying(trace, point.source, free, self.cache)

    @cached_property
    def recordings(self) -> Recordings:
        """The rays that this sweep records."""
        return Recordings(self.store, self.simulator, self.spec, self.cache)

    def describe(self, entry: Entry) -> str:
        """A point in words, for messages."""
        parts = [f"{name}={label}" for name, label in entry.labels.items()]
        return ", ".join([entry.scene, *parts])


def plan_sweep(spec: Spec, simulator: Simulator, store: Store, cache: Path) -> Sweep:
    """Expands the spec and records the points; the store must be open."""
    points = expand(spec, simulator.parameters)
    if spec.replay:
        points = mark_replayed(points)
    return Sweep(spec, simulator, store, points, store.plan(spec, simulator, points), cache)


@dataclass(frozen=True)
class Result:
    """How a call of a sweep ended."""

    total: int
    already_done: int
    done: int
    remembered: int  # refused earlier, and not tried again
    tally: Tally

    @property
    def status(self) -> Exit:
        if self.tally.interrupted:
            return Exit.INTERRUPTED
        return Exit.FAILED_POINTS if self.tally.failed or self.remembered else Exit.OK


def run_sweep(sweep: Sweep, choice: ClusterChoice, say: Say) -> Result:
    """Runs what has no result yet, and says what has failed before."""
    jobs = sweep.jobs()
    refused = {job.id: why for job in jobs if (why := sweep.store.refusal(job.id))}
    names = {entry.id: sweep.describe(entry) for entry in sweep.entries}
    for point, why in refused.items():
        say(f"failed before: {point} ({names[point]}): {why}")
    todo = [job for job in jobs if job.id not in refused]
    tally = Tally()
    if todo:
        with open_cluster(choice) as client:
            sweep, tally = _record(client, sweep, say)
            if not tally.interrupted:
                tally = run_jobs(client, sweep, [j for j in sweep.jobs() if j.id not in refused])
    return _result(sweep, len(jobs), len(refused), tally)


def _record(client: Client, sweep: Sweep, say: Say) -> tuple[Sweep, Tally]:
    """Records what the sweep replays; points whose recording fails are traced live instead."""
    groups = sweep.recordings.missing(
        point
        for entry, point in zip(sweep.entries, sweep.points, strict=True)
        if not sweep.store.is_done(entry.id)
    )
    if not groups:
        return sweep, Tally()
    jobs = [sweep.recordings.job(group) for group in groups]
    store = sweep.recordings.store
    with ProgressWatcher(len(jobs), {job.id: "recording" for job in jobs}) as watcher:
        tally = Engine(client, store, sweep.spec.limits.retries, watcher).run(jobs)
    if not tally.failed:
        return sweep, tally
    say("points without a recording are traced live")
    points = [
        point
        if not point.from_recording or sweep.recordings.is_there(recorded_by(point))
        else replace(point, from_recording=False)
        for point in sweep.points
    ]
    entries = sweep.store.plan(sweep.spec, sweep.simulator, points)
    return replace(sweep, points=points, entries=entries), tally


def _result(sweep: Sweep, todo: int, remembered: int, tally: Tally) -> Result:
    # Counted in the folder: an interrupt can come between a result and its account.
    done = sum(sweep.store.is_done(entry.id) for entry in sweep.entries)
    return Result(len(sweep.points), len(sweep.points) - todo, done, remembered, tally)


def run_jobs(client: Client, sweep: Sweep, jobs: list[Job]) -> Tally:
    """Runs these jobs with progress."""
    names = {entry.id: sweep.describe(entry) for entry in sweep.entries}
    with ProgressWatcher(len(jobs), names) as watcher:
        return Engine(client, sweep.store, sweep.spec.limits.retries, watcher).run(jobs)


def summary(result: Result, folder: Path) -> str:
    """The last lines of a sweep."""
    text = f"{result.done} of {result.total} points done"
    if result.already_done:
        text += f", {result.already_done} of them before"
    failed = len(result.tally.failed) + result.remembered
    if failed:
        text += f"; {failed} failed, see {folder / 'failures'}"
    if result.tally.interrupted:
        text += "; interrupted: the same command resumes"
    return text


def probe(sweep: Sweep, choice: ClusterChoice, count: int, say: Say) -> Result:
    """Runs a few points, spread over the sweep, and says how long the others will take.

    Probes are points like all others: their results are kept.
    """
    jobs = [job for job in sweep.jobs() if not sweep.store.refusal(job.id)]
    count = min(count, len(jobs))
    chosen = [jobs[i * (len(jobs) - 1) // max(count - 1, 1)] for i in range(count)]
    tally = Tally()
    if chosen:
        with open_cluster(choice) as client:
            sweep, tally = _record(client, sweep, say)
            if not tally.interrupted:
                names = {job.id for job in chosen}
                tally = run_jobs(client, sweep, [j for j in sweep.jobs() if j.id in names])
    left = len(jobs) - tally.done - len(tally.failed)
    times = tally.seconds or [
        record["seconds"] for record in sweep.store.journal() if record["kind"] == "done"
    ]
    if times and not tally.interrupted:
        say(_estimate(left, times, choice))
    return _result(sweep, len(jobs), 0, tally)


def _estimate(left: int, times: list[float], choice: ClusterChoice) -> str:
    if not left:
        return "nothing is left to run"
    mean = sum(times) / len(times)
    parts = [f"{left} points left, {format_duration(mean)} each by {len(times)} probes"]
    if choice.scheduler or choice.scheduler_file or choice.slurm:
        parts.append(f"{format_duration(mean * left)} of one worker's time")
    else:
        at_once = choice.workers
        low, high = (format_duration(t * left / at_once) for t in (min(times), max(times)))
        parts.append(
            f"about {format_duration(mean * left / at_once)} with {at_once} at a time"
            f" (from {low} to {high})"
        )
    return ": ".join(parts)
