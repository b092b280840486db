# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations of the paper's experiments: named by what they set, run by the engine of sweeps."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from sheaf_explore.cluster import ClusterChoice
from sheaf_explore.derived import derive
from sheaf_explore.parameters import Value
from sheaf_explore.points import Point
from sheaf_explore.simulator import Simulator
from sheaf_explore.spec import Source, Spec
from sheaf_explore.store import Entry, Store
from sheaf_explore.sweep import Result, run_sweep, Say, Sweep

NAN = math.nan


@dataclass(frozen=True)
class Scene:
    """A scene that is compared with one of the paper's."""

    name: str
    path: Path
    stands_for: str  # the paper's name
    settings: tuple[tuple[str, Value], ...] = ()  # that it always has

    @property
    def real(self) -> bool:
        """Whether it is the paper's own model instead of a stand-in."""
        return self.name != self.stands_for


@dataclass(frozen=True)
class Run:
    """One simulation. Two runs that set the same are the same, whatever asks for them."""

    scene: Scene
    settings: tuple[tuple[str, Value], ...]
    asked_by: str = field(compare=False, default="")


class Results:
    """What came out of runs: counters and derived columns by name."""

    def __init__(self, values: Mapping[Run, Mapping[str, float]]) -> None:
        self._values = values

    def get(self, run: Run, counter: str) -> float:
        """A counter of a run; not a number if the run failed or has no such counter."""
        return float(self._values.get(run, {}).get(counter, NAN))

    def counters(self, run: Run) -> Mapping[str, float]:
        """All counters of a run."""
        return self._values.get(run, {})


@dataclass(frozen=True)
class Workshop:
    """Where and how runs are made."""

    simulator: Simulator
    store: Store
    cache: Path
    choice: ClusterChoice
    say: Say


def _point(run: Run) -> Point:
    source = Source("scene", run.scene.path, run.scene.name)
    return Point(source, {"experiment": run.asked_by}, dict(run.settings))


def simulate(runs: Iterable[Run], shop: Workshop) -> tuple[Results, Result]:
    """Makes the runs that have no result yet, each once, and reads them all."""
    unique = list(dict.fromkeys(runs))
    points = [_point(run) for run in unique]
    sources = tuple(dict.fromkeys(point.source for point in points))
    spec = Spec(Path("paper"), "", "The paper's experiments", sources, {}, ())
    with shop.store.opened():
        entries = shop.store.plan(spec, shop.simulator, points)
        sweep = Sweep(spec, shop.simulator, shop.store, points, entries, shop.cache)
        result = run_sweep(sweep, shop.choice, shop.say)
    values = {
        run: _numbers(shop, entry)
        for run, entry in zip(unique, entries, strict=True)
        if shop.store.is_done(entry.id)
    }
    return Results(values), result


def _numbers(shop: Workshop, entry: Entry) -> dict[str, float]:
    """All counters and derived columns of a finished run."""
    stats = {name: field["value"] for name, field in shop.store.stats(entry.id).items()}
    derived = {name: value for name, (value, _) in derive(stats).items()}
    numbers = stats | derived
    return {name: v for name, v in numbers.items() if isinstance(v, (int, float))}
