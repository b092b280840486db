# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The points of a sweep: every combination, or a sample of them, less what conditions drop."""

from __future__ import annotations

import hashlib
import itertools
import json
import random
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameters, Value
from sheaf_explore.spec import Axis, Choice, Outputs, Source, Spec

MAX_POINTS = 1_000_000
ID_LENGTH = 20  # hexadecimal digits: 80 bits, no two of a million points alike


@dataclass(frozen=True)
class Point:
    """One machine on one scene or trace. `labels` has the place on each axis."""

    source: Source
    labels: dict[str, Value]
    settings: dict[str, Value]
    from_recording: bool = False  # replays rays that the sweep records of its scene
    outputs: Outputs = field(default_factory=Outputs)

    @property
    def mode(self) -> str:
        """Whether the rays are traced live or replayed."""
        return "replayed" if self.from_recording or self.source.kind == "trace" else "live"

    def output_options(self) -> list[str]:
        """Options of the simulator for what is to be written; none if that is the usual."""
        words = []
        if not self.outputs.images and self.mode == "live":  # a replay makes no pictures
            words.append("--no-images")
        if self.outputs.timeline and self.settings.get("run.fidelity", "timed") == "timed":
            words.append("--timeline")
            if self.outputs.timeline_window:
                words += ["--timeline-window", self.outputs.timeline_window]
        return words


def point_id(point: Point, parameters: Parameters, source_hash: str, binary_hash: str) -> str:
    """Names a point by the resolved configuration, what it simulates, and the simulator.

    A setting that repeats a default changes nothing, and neither does the way a value is written.
    Files that it is to write beside the usual ones are part of it.
    """
    resolved = {**parameters.defaults, **point.settings}
    identity: dict[str, Any] = {
        "binary": binary_hash,
        "configuration": {key: resolved[key] for key in sorted(resolved)},
        "mode": point.mode,
        "source": source_hash,
    }
    if written := point.output_options():
        identity["outputs"] = written
    text = json.dumps(identity, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:ID_LENGTH]


def expand(spec: Spec, parameters: Parameters) -> list[Point]:
    """The points in the order of the axes, the last axis changing fastest; no two are alike."""
    if not spec.sample and any(axis.continuum for axis in spec.axes):
        raise ExploreError(f"{spec.path}: a range without steps needs [sample] or explore optimize")
    combinations = _sampled(spec, parameters) if spec.sample else _product(spec)
    points: list[Point] = []
    seen: set[tuple[object, ...]] = set()
    for source, choices in combinations:
        point = make_point(spec, source, choices)
        values = {**parameters.defaults, **point.settings}
        if any(condition.holds(values) for condition in spec.drop):
            continue
        identity = (source.path, *sorted(values.items()))
        if identity not in seen:
            seen.add(identity)
            points.append(point)
    if not points:
        raise ExploreError(f"{spec.path}: no point is left; the conditions in drop take them all")
    return points


def make_point(spec: Spec, source: Source, choices: Iterable[Choice]) -> Point:
    """The point with one choice for each axis."""
    settings = dict(spec.settings)
    labels: dict[str, Value] = {}
    for axis, choice in zip(spec.axes, choices, strict=True):
        settings |= choice.settings
        labels[axis.name] = choice.label
    return Point(source, labels, settings, outputs=spec.outputs)


def _product(spec: Spec) -> Iterator[tuple[Source, tuple[Choice, ...]]]:
    count = len(spec.sources)
    for axis in spec.axes:
        count *= len(axis.choices)
    if count > MAX_POINTS:
        raise ExploreError(
            f"{spec.path}: the axes make {count} points, the limit is {MAX_POINTS}; use [sample]"
        )
    for source in spec.sources:
        for choices in itertools.product(*(axis.choices for axis in spec.axes)):
            yield source, choices


def _sampled(spec: Spec, parameters: Parameters) -> Iterator[tuple[Source, tuple[Choice, ...]]]:
    """Each scene gets its own sample of the axes.

    Latin hypercube (McKay, Beckman, Conover 1979, section 2.3): of n points each has one of n equal
    shares of every axis to itself, at a random place in the share.
    """
    assert spec.sample is not None
    generator = random.Random(spec.sample.seed)
    n = spec.sample.points
    for source in spec.sources:
        columns = []
        for axis in spec.axes:
            if spec.sample.method == "latin-hypercube":
                shares = [(i + generator.random()) / n for i in range(n)]
                generator.shuffle(shares)
            else:
                shares = [generator.random() for _ in range(n)]
            columns.append([place_on(axis, share, parameters) for share in shares])
        for i in range(n):
            yield source, tuple(column[i] for column in columns)


def place_on(axis: Axis, share: float, parameters: Parameters) -> Choice:
    """The choice at 0 <= share < 1 of the axis."""
    if axis.continuum is None:
        return axis.choices[min(int(share * len(axis.choices)), len(axis.choices) - 1)]
    value: Value = axis.continuum.at(share)
    parameter = parameters[axis.keys[0]]
    if parameter.quantity == "bytes":
        value = round(axis.continuum.at(share))
    value = parameter.check(value)
    return Choice(value, {axis.keys[0]: value})
