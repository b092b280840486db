# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""What a sweep spec says, read and checked before anything runs."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from sheaf_explore.conditions import Condition
from sheaf_explore.parameters import Value
from sheaf_explore.ranges import Continuum

SourceKind = Literal["scene", "trace"]


@dataclass(frozen=True)
class Source:
    """What a point simulates: a scene, traced live, or a recorded trace, replayed."""

    kind: SourceKind
    path: Path  # as it can be opened
    name: str  # as the spec writes it


@dataclass(frozen=True)
class Choice:
    """One place on an axis: what it is called there and what it sets."""

    label: Value
    settings: dict[str, Value]


@dataclass(frozen=True)
class Axis:
    """One dimension of the sweep; either `choices` or, for samples only, `continuum`."""

    name: str
    keys: tuple[str, ...]
    choices: tuple[Choice, ...] = ()
    continuum: Continuum | None = None


@dataclass(frozen=True)
class Sample:
    """Draw so many points instead of taking the whole product."""

    method: Literal["random", "latin-hypercube"]
    points: int
    seed: int


@dataclass(frozen=True)
class Limits:
    """What one point may take; None is no limit."""

    seconds: float | None = None
    memory: int | None = None  # bytes of address space
    retries: int = 2  # after a signal


@dataclass(frozen=True)
class Outputs:
    """What a point leaves behind beside its counters."""

    images: bool = True
    timeline: bool = False  # of the points that simulate time
    timeline_window: str = ""  # cycles FIRST..END; empty: all


@dataclass(frozen=True)
class Fidelity:
    """One level of an optimization: settings that make runs cheaper, and share of the budget."""

    name: str
    settings: dict[str, Value]
    share: float


@dataclass(frozen=True)
class Optimize:
    """Find the Pareto front of these columns; the last fidelity confirms it."""

    minimize: tuple[str, ...]
    maximize: tuple[str, ...]
    budget: int
    batch: int
    seed: int
    fidelities: tuple[Fidelity, ...]


@dataclass(frozen=True)
class Spec:
    """A sweep."""

    path: Path
    text: str
    name: str
    sources: tuple[Source, ...]
    settings: dict[str, Value]
    axes: tuple[Axis, ...]
    sample: Sample | None = None
    drop: tuple[Condition, ...] = ()
    replay: bool = False  # record each scene once and replay where that can serve
    limits: Limits = field(default_factory=Limits)
    outputs: Outputs = field(default_factory=Outputs)
    measures: tuple[str, ...] = ()  # columns that the report shows first
    optimize: Optimize | None = None
