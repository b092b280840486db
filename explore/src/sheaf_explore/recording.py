# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings that a sweep makes of its scenes, once for points that differ in the machine alone.

A ray trace replays on any ray cache, heuristic, packet size, traversal and memory; what the rays
themselves depend on must be as it was recorded, and is what points with one recording share.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from sheaf_explore.parameters import Value
from sheaf_explore.points import Point
from sheaf_explore.simulator import Simulator
from sheaf_explore.spec import Spec
from sheaf_explore.store import Entry, Store
from sheaf_explore.task import Job

# What `sheaf replay` refuses to change.
_SHAPES_RAYS = ("image.width", "image.height", "scene.", "camera.", "light.", "render.")
_WORTH_RECORDING = 2  # points with one recording, from which on it is made

Group = tuple[Path, tuple[tuple[str, Value], ...]]


def _shape(settings: dict[str, Value]) -> dict[str, Value]:
    return {key: value for key, value in settings.items() if key.startswith(_SHAPES_RAYS)}


def replayable(settings: dict[str, Value]) -> dict[str, Value]:
    """The settings that a replay can choose."""
    return {key: value for key, value in settings.items() if not key.startswith(_SHAPES_RAYS)}


def recorded_by(point: Point) -> Point:
    """The run that records the rays of a point: all that shapes them, the rest at its default."""
    return Point(point.source, {}, _shape(point.settings))


def _group(point: Point) -> Group:
    return point.source.path, tuple(sorted(_shape(point.settings).items()))


def _can_replay(point: Point) -> bool:
    """Whether a replay could serve: it makes no heat maps."""
    return point.source.kind == "scene" and not point.settings.get("image.heat_maps")


def mark_replayed(points: list[Point]) -> list[Point]:
    """The points, those that share their rays with others as replays."""
    served = [point for point in points if _can_replay(point)]
    sizes = Counter(_group(point) for point in served)
    return [
        replace(
            point,
            from_recording=_can_replay(point) and sizes[_group(point)] >= _WORTH_RECORDING,
        )
        for point in points
    ]


class Recordings:
    """The recordings of a sweep, in its folder `traces`, kept like points."""

    def __init__(self, store: Store, simulator: Simulator, spec: Spec, cache: Path) -> None:
        self.store = Store(store.folder / "traces")
        self._simulator = simulator
        self._spec = spec
        self._cache = cache
        self._entries: dict[Group, Entry] = {}

    def entry(self, recording: Point) -> Entry:
        """The name of a recording."""
        group = _group(recording)
        if group not in self._entries:
            [self._entries[group]] = self.store.name(self._simulator, [recording])
        return self._entries[group]

    def trace(self, entry: Entry) -> Path:
        """The file of a recording."""
        return self.store.folder / "points" / entry.id / "rays.trace"

    def is_there(self, recording: Point) -> bool:
        """Whether the recording has been made."""
        return self.trace(self.entry(recording)).is_file()

    def missing(self, points: Iterable[Point]) -> list[Point]:
        """The recordings that these points need and that are not there."""
        wanted = {_group(p): recorded_by(p) for p in points if p.from_recording}
        return [recording for recording in wanted.values() if not self.is_there(recording)]

    def job(self, recording: Point) -> Job:
        """The work order of a recording."""
        words = self._simulator.recording(recording.source, recording.settings, self._cache)
        return self.store.job(self.entry(recording), words, self._spec, self._simulator)
