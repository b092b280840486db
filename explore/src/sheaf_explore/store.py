# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The folder of a sweep.

sweep.json            the points of the last spec run here, in order
spec.toml             that spec
points/<id>/          the finished runs, each whole
work/<id>/            runs under way, with a lock that ends with its holder
failures/<id>.json    points that failed, and why
journal.jsonl         one line a simulation that ran: what became of it, how long it took
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import shutil
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from sheaf_explore.errors import Exit, ExploreError
from sheaf_explore.parameters import Parameters, Value
from sheaf_explore.points import Point, point_id
from sheaf_explore.simulator import hash_source, Simulator
from sheaf_explore.spec import Spec
from sheaf_explore.task import failure_text, is_done, Job, Outcome

FORMAT = 1


@dataclass(frozen=True)
class Entry:
    """A point of the sweep with its name."""

    id: str
    scene: str
    mode: str
    labels: dict[str, Value]
    settings: dict[str, Value]


def write_whole(path: Path, text: str | bytes) -> None:
    """Writes a file that appears whole or not at all."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    data = text.encode() if isinstance(text, str) else text
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_bytes(data)
        temporary.replace(path)
    except OSError as error:
        raise ExploreError(f"{path}: cannot be written: {error.strerror}", Exit.OUTPUT) from None


class Store:
    """Reads and writes one sweep's folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()

    @contextlib.contextmanager
    def opened(self) -> Iterator[None]:
        """Makes the folder and holds it against another sweep; clears what dead runs left."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            entries = {path.name for path in self.folder.iterdir()}
            if entries and not entries & {"sweep.json", ".lock"}:
                raise ExploreError(
                    f"{self.folder}: holds files that are no sweep; choose another --out",
                    Exit.OUTPUT,
                )
            stream = (self.folder / ".lock").open("a")
        except OSError as error:
            raise ExploreError(
                f"{self.folder}: cannot be written: {error.strerror}; choose another --out",
                Exit.OUTPUT,
            ) from None
        with stream:
            try:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise ExploreError(
                    f"{self.folder}: another sweep is running here; wait for it or choose --out"
                ) from None
            self._clear_abandoned()
            yield

    def _clear_abandoned(self) -> None:
        """Removes work folders whose lock nobody holds: their runs were killed."""
        work = self.folder / "work"
        if not work.is_dir():
            return
        for path in work.iterdir():
            with contextlib.suppress(OSError), (path / "lock").open("a") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(path, ignore_errors=True)

    # What is to be done ------------------------------------------------------------------------

    def plan(self, spec: Spec, simulator: Simulator, points: list[Point]) -> list[Entry]:
        """Names the points and records them."""
        entries = self.name(simulator, points)
        write_whole(self.folder / "sweep.json", _sweep_text(spec, simulator, entries))
        write_whole(self.folder / "spec.toml", spec.text)
        return entries

    def name(self, simulator: Simulator, points: list[Point]) -> list[Entry]:
        """The points with their names."""
        hashes = {source: hash_source(source) for source in {p.source for p in points}}
        return [
            Entry(
                point_id(point, simulator.parameters, hashes[point.source], simulator.hash),
                point.source.name,
                point.mode,
                point.labels,
                point.settings,
            )
            for point in points
        ]

    def job(self, entry: Entry, arguments: list[str], spec: Spec, simulator: Simulator) -> Job:
        """The work order of a point, or of a recording."""
        return Job(
            entry.id,
            str(self.folder),
            tuple(arguments),
            _point_text(entry, simulator.hash),
            "--parent" in simulator.options(arguments[1]),
            spec.limits.seconds,
            spec.limits.memory,
        )

    # What has been done ------------------------------------------------------------------------

    def is_done(self, point: str) -> bool:
        return is_done(self.folder, point)

    def refusal(self, point: str) -> str | None:
        """Why the simulator refused this point before; it would again. None if it did not."""
        failure = self.failure(point)
        return failure["message"] if failure and failure["kind"] == "refused" else None

    def failure(self, point: str) -> dict[str, Any] | None:
        """The record of a failed point."""
        try:
            record = json.loads((self.folder / "failures" / f"{point}.json").read_text())
        except (OSError, ValueError):
            return None
        return record if isinstance(record, dict) and "kind" in record else None

    def record(self, job: Job, outcome: Outcome, final: bool) -> None:
        """Keeps what became of an attempt; `final` if there will be no other."""
        failure = self.folder / "failures" / f"{job.id}.json"
        if outcome.kind == "done":
            failure.unlink(missing_ok=True)
        elif final and outcome.kind != "cancelled":
            write_whole(failure, failure_text(outcome, job.point))
        if outcome.fresh:
            # One write of whole lines; an end torn off by a kill is skipped when reading.
            line = "\n" + json.dumps(asdict(outcome), sort_keys=True) + "\n"
            with (self.folder / "journal.jsonl").open("a") as journal:
                journal.write(line)

    def journal(self) -> list[dict[str, Any]]:
        """What ran, in order."""
        try:
            lines = (self.folder / "journal.jsonl").read_text().splitlines()
        except OSError:
            return []
        records = []
        for line in lines:
            with contextlib.suppress(ValueError):
                record = json.loads(line) if line else None
                if isinstance(record, dict) and "id" in record:
                    records.append(record)
        return records

    def processor_seconds(self) -> float:
        """What the recorded sweep's finished points took, each by its last simulation."""
        took = {record["id"]: record["cpu_seconds"] for record in self.journal()}
        points = {entry["id"] for entry in self.sweep()["points"]}
        return float(sum(took.get(point, 0.0) for point in points))

    def sweep(self) -> dict[str, Any]:
        """The recorded sweep. Raises ExploreError if there is none."""
        path = self.folder / "sweep.json"
        try:
            document = json.loads(path.read_text())
        except (OSError, ValueError):
            raise ExploreError(f"{self.folder}: is no sweep; run `explore sweep` first") from None
        if not isinstance(document, dict) or document.get("format") != FORMAT:
            raise ExploreError(f"{path}: was written by another version; run the sweep again")
        return document

    def stats(self, point: str) -> dict[str, dict[str, Any]]:
        """Every counter of a finished point: value and unit."""
        path = self.folder / "points" / point / "stats.json"
        try:
            document = json.loads(path.read_text())
        except (OSError, ValueError) as error:
            raise ExploreError(
                f"{path}: is damaged ({error}); remove the folder and run the sweep again"
            ) from None
        if not isinstance(document, dict):
            raise ExploreError(f"{path}: holds no counters; remove the folder and run again")
        return document


def _point_text(entry: Entry, binary: str) -> str:
    record = asdict(entry) | {"binary": binary}
    del record["labels"]  # how one spec calls the point, not what the point is
    return json.dumps(record, indent=1, sort_keys=True) + "\n"


def _sweep_text(spec: Spec, simulator: Simulator, entries: list[Entry]) -> str:
    parameters: Parameters = simulator.parameters
    axes = [
        {
            "name": axis.name,
            "keys": list(axis.keys),
            "labels": [
                parameters[axis.keys[0]].text(choice.label)
                if axis.keys[0] in choice.settings and choice.settings[axis.keys[0]] == choice.label
                else str(choice.label)
                for choice in axis.choices
            ],
            "values": [choice.label for choice in axis.choices],
            "unit": parameters[axis.keys[0]].quantity if axis.name in parameters else "",
        }
        for axis in spec.axes
    ]
    keys = {key for entry in entries for key in entry.settings}
    document = {
        "format": FORMAT,
        "name": spec.name,
        "binary": simulator.hash,
        "axes": axes,
        "measures": list(spec.measures),
        "defaults": simulator.parameters.defaults,
        "meanings": {key: parameters[key].meaning for key in sorted(keys)},
        "points": [asdict(entry) for entry in entries],
    }
    return json.dumps(document, indent=1) + "\n"
