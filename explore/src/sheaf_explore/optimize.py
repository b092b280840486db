# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the Pareto front of a large space with a budget of runs.

The first fidelity searches, with Optuna's tree-structured Parzen estimator (Bergstra et al. 2011;
for several objectives Ozaki et al. 2020). Each further fidelity runs the best of the one before
again, front after front (non-dominated sorting, Deb et al. 2002), and the last confirms the front.
Batches have a fixed size and are told in order, so that the same seed asks for the same points
however many workers there are, and an interrupted search resumes by asking again.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import optuna
from distributed import Client
from rich.console import Console
from rich.table import Table as RichTable

from sheaf_explore.analysis import pareto_front
from sheaf_explore.cluster import ClusterChoice, open_cluster
from sheaf_explore.derived import derive
from sheaf_explore.errors import Exit, ExploreError
from sheaf_explore.points import make_point, place_on, Point
from sheaf_explore.simulator import Simulator
from sheaf_explore.spec import Axis, Choice, Fidelity, Optimize, Spec
from sheaf_explore.store import Entry, Store, write_whole
from sheaf_explore.sweep import run_jobs, Say, Sweep

_ASKS_A_RUN = 20  # how often the search may ask for what is known or dropped, before it ends

Choices = tuple[Choice, ...]
Values = tuple[float, ...]


class _InterruptedError(Exception):
    """Ctrl-C during a batch."""


@dataclasses.dataclass(frozen=True)
class _Candidate:
    """A machine with its objectives, negated where they are to be maximized."""

    choices: Choices
    values: Values


class _Search:
    """One call of explore optimize."""

    def __init__(
        self, spec: Spec, simulator: Simulator, store: Store, cache: Path, client: Client
    ) -> None:
        assert spec.optimize is not None
        self._spec = spec
        self._wanted: Optimize = spec.optimize
        self._simulator = simulator
        self._store = store
        self._cache = cache
        self._client = client

    # Running -----------------------------------------------------------------------------------

    def at(self, level: Fidelity) -> Spec:
        return dataclasses.replace(self._spec, settings=self._spec.settings | level.settings)

    def points(self, level: Fidelity, choices: Choices) -> list[Point]:
        return [make_point(self.at(level), source, choices) for source in self._spec.sources]

    def run(self, level: Fidelity, batch: list[Choices]) -> list[Values | None]:
        """The objectives of each machine at a fidelity; None for one that failed."""
        points = [self.points(level, choices) for choices in batch]
        flat = [point for group in points for point in group]
        entries = self._store.name(self._simulator, flat)
        sweep = Sweep(self.at(level), self._simulator, self._store, flat, entries, self._cache)
        jobs = {job.id: job for job in sweep.jobs() if not self._store.refusal(job.id)}
        if jobs and run_jobs(self._client, sweep, list(jobs.values())).interrupted:
            raise _InterruptedError
        size = len(self._spec.sources)
        groups = [entries[i : i + size] for i in range(0, len(entries), size)]
        return [self._objectives(group) for group in groups]

    def _objectives(self, entries: list[Entry]) -> Values | None:
        """The mean over all scenes of each objective."""
        rows = []
        for entry in entries:
            if not self._store.is_done(entry.id):
                return None
            rows.append(self._values(entry))
        return tuple(float(x) for x in np.mean(np.array(rows), axis=0))

    def _values(self, entry: Entry) -> list[float]:
        stats = self._store.stats(entry.id)
        counters = {name: field["value"] for name, field in stats.items()}
        columns = counters | {name: value for name, (value, _) in derive(counters).items()}
        values = []
        for sign, names in ((1.0, self._wanted.minimize), (-1.0, self._wanted.maximize)):
            for name in names:
                if not isinstance(columns.get(name), (int, float)):
                    raise ExploreError(
                        f"{self._spec.path}: no point has a number {name!r} to optimize; "
                        f"see {self._store.folder / 'points' / entry.id / 'stats.json'}"
                    )
                values.append(sign * float(columns[name]))
        return values

    # Searching ---------------------------------------------------------------------------------

    def search(self, level: Fidelity, budget: int) -> list[_Candidate]:
        """Asks Optuna for machines until the budget is used or it has nothing new."""
        optuna.logging.set_verbosity(optuna.logging.ERROR)
        count = len(self._wanted.minimize) + len(self._wanted.maximize)
        sampler = optuna.samplers.TPESampler(
            seed=self._wanted.seed, n_startup_trials=max(budget // 4, self._wanted.batch)
        )
        study = optuna.create_study(directions=["minimize"] * count, sampler=sampler)
        known: dict[tuple[Any, ...], Values | None] = {}
        found: list[_Candidate] = []
        asks = 0
        while len(known) < budget and asks < _ASKS_A_RUN * budget:
            asked = []
            for _ in range(min(self._wanted.batch, budget - len(known))):
                trial = study.ask()
                asked.append((trial, self.choose(trial)))
                asks += 1
            fresh = {
                _key(choices): choices
                for _, choices in asked
                if choices is not None and _key(choices) not in known
            }
            values = self.run(level, list(fresh.values()))
            known |= dict(zip(fresh, values, strict=True))
            for trial, choices in asked:
                result = known[_key(choices)] if choices is not None else None
                if result is None:
                    study.tell(trial, state=optuna.trial.TrialState.FAIL)
                else:
                    study.tell(trial, result)
            found += [_Candidate(fresh[key], v) for key in fresh if (v := known[key]) is not None]
        return found

    def choose(self, trial: optuna.Trial) -> Choices | None:
        """The machine that a trial stands for, or None if conditions drop it."""
        parameters = self._simulator.parameters
        choices = tuple(_suggest(trial, axis, self._simulator) for axis in self._spec.axes)
        settings = make_point(self._spec, self._spec.sources[0], choices).settings
        values = {**parameters.defaults, **settings}
        return None if any(c.holds(values) for c in self._spec.drop) else choices

    def confirm(self, level: Fidelity, best: list[_Candidate]) -> list[_Candidate]:
        """The same machines at another fidelity, in batches."""
        confirmed = []
        for i in range(0, len(best), self._wanted.batch):
            batch = [candidate.choices for candidate in best[i : i + self._wanted.batch]]
            for choices, values in zip(batch, self.run(level, batch), strict=True):
                if values is not None:
                    confirmed.append(_Candidate(choices, values))
        return confirmed


def _suggest(trial: optuna.Trial, axis: Axis, simulator: Simulator) -> Choice:
    if axis.continuum is not None:
        share = trial.suggest_float(axis.name, 0.0, np.nextafter(1.0, 0.0).item())
        return place_on(axis, share, simulator.parameters)
    ordered = all(
        isinstance(c.label, (int, float)) and not isinstance(c.label, bool) for c in axis.choices
    )
    if ordered:
        return axis.choices[trial.suggest_int(axis.name, 0, len(axis.choices) - 1)]
    places = list(range(len(axis.choices)))
    return axis.choices[int(str(trial.suggest_categorical(axis.name, places)))]


def _key(choices: Choices) -> tuple[Any, ...]:
    return tuple(choice.label for choice in choices)


def _matrix(candidates: list[_Candidate]) -> npt.NDArray[np.float64]:
    return np.array([candidate.values for candidate in candidates], dtype=float)


def by_fronts(candidates: list[_Candidate]) -> Iterator[_Candidate]:
    """All candidates, the Pareto front first, then the front of the rest, and so on."""
    left = candidates
    while left:
        front = pareto_front(_matrix(left))
        yield from (c for c, on in zip(left, front, strict=True) if on)
        left = [c for c, on in zip(left, front, strict=True) if not on]


def _shares(budget: int, levels: tuple[Fidelity, ...]) -> list[int]:
    """Splits the budget by the levels' shares; each has at least one run."""
    total = sum(level.share for level in levels)
    counts = [max(1, int(budget * level.share / total)) for level in levels]
    counts[0] += max(0, budget - sum(counts))
    return counts


def optimize(
    spec: Spec,
    simulator: Simulator,
    store: Store,
    cache: Path,
    choice: ClusterChoice,
    budget: int | None,
    say: Say,
) -> Exit:
    """Searches, confirms, and leaves the confirmed machines as a sweep with its front."""
    if spec.optimize is None:
        raise ExploreError(f"{spec.path}: has no [optimize] to say what to minimize")
    levels = spec.optimize.fidelities
    with store.opened(), open_cluster(choice) as client:
        search = _Search(spec, simulator, store, cache, client)
        found: list[_Candidate] = []
        try:
            counts = _shares(budget or spec.optimize.budget, levels)
            for i, (level, count) in enumerate(zip(levels, counts, strict=True)):
                say(f"{level.name}: {count} machines")
                best = list(by_fronts(found))[:count]
                found = search.confirm(level, best) if i else search.search(level, count)
                if not found:
                    raise ExploreError(f"every machine failed at fidelity {level.name}")
        except _InterruptedError:
            say("interrupted: the same command resumes")
            return Exit.INTERRUPTED
        points = [p for c in found for p in search.points(levels[-1], c.choices)]
        store.plan(search.at(levels[-1]), simulator, points)
        _show_front(spec, simulator, store, found, say)
    return Exit.OK


def _show_front(
    spec: Spec, simulator: Simulator, store: Store, found: list[_Candidate], say: Say
) -> None:
    """Prints the front and writes front.json."""
    assert spec.optimize is not None
    front = [c for c, on in zip(found, pareto_front(_matrix(found)), strict=True) if on]
    front.sort(key=lambda candidate: candidate.values)
    names = [*spec.optimize.minimize, *spec.optimize.maximize]
    signs = [1.0] * len(spec.optimize.minimize) + [-1.0] * len(spec.optimize.maximize)
    table = RichTable(title=f"Pareto front: {len(front)} of {len(found)} confirmed machines")
    for column in [axis.name for axis in spec.axes] + names:
        table.add_column(column)
    records = []
    for candidate in front:
        labels = {
            axis.name: simulator.parameters[axis.name].text(c.label)
            if axis.name in simulator.parameters
            else str(c.label)
            for axis, c in zip(spec.axes, candidate.choices, strict=True)
        }
        values = [sign * value for sign, value in zip(signs, candidate.values, strict=True)]
        table.add_row(*labels.values(), *(f"{value:,.6g}" for value in values))
        records.append({"machine": labels, "values": dict(zip(names, values, strict=True))})
    write_whole(store.folder / "front.json", json.dumps(records, indent=1) + "\n")
    console = Console()
    if not console.is_terminal:
        console.width = 200
    console.print(table)
    say(f"front: {store.folder / 'front.json'}; plots: explore report {store.folder}")
