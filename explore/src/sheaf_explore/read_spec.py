# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Reads a sweep spec; every refusal names file and line."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any, cast, NoReturn

from sheaf_explore.conditions import Condition
from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameters, Value
from sheaf_explore.quantities import is_window, parse_bytes, parse_duration
from sheaf_explore.ranges import Continuum, parse_range
from sheaf_explore.spec import (
    Axis,
    Choice,
    Fidelity,
    Limits,
    Optimize,
    Outputs,
    Sample,
    Source,
    SourceKind,
    Spec,
)
from sheaf_explore.toml_lines import line_of
from sheaf_explore.toml_lines import Path as Place

MAX_SPEC_BYTES = 1 << 20
MAX_SAMPLES = 1_000_000

_TOP = {"name", "scenes", "traces", "set", "axis", "sample", "replay"} | {
    "drop",
    "limits",
    "outputs",
    "measures",
    "optimize",
}


class _Reader:
    """Walks through one document and knows the place of everything in it."""

    def __init__(self, path: Path, text: str, parameters: Parameters) -> None:
        self.path = path
        self.text = text
        self.parameters = parameters
        try:
            self.document: dict[str, Any] = tomllib.loads(text)
        except (tomllib.TOMLDecodeError, RecursionError) as error:
            raise ExploreError(f"{path}: {error}") from None

    def fail(self, place: Place, problem: object) -> NoReturn:
        raise ExploreError(f"{self.path}:{line_of(self.text, place)}: {problem}")

    def only(self, place: Place, table: dict[str, Any], known: set[str]) -> None:
        for key in table:
            if key not in known:
                expected = ", ".join(sorted(known))
                self.fail((*place, key), f"unknown key {key!r}; expected {expected}")

    def get(self, place: Place, table: dict[str, Any], key: str, kind: type, default: Any) -> Any:
        """A value of the given type; whole numbers pass as float, truth values never as numbers."""
        value = table.get(key, default)
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            if value is default:
                return default
            names = {
                str: "text",
                int: "a whole number",
                float: "a number",
                list: "a list",
                bool: "true or false",
            }
            self.fail((*place, key), f"{key} must be {names.get(kind, 'a table')}")
        return value

    def texts(self, place: Place, table: dict[str, Any], key: str) -> list[str]:
        values = self.get(place, table, key, list, [])
        for i, value in enumerate(values):
            if not isinstance(value, str) or not value:
                self.fail((*place, key), f"entry {i + 1} of {key} must be text")
        return cast(list[str], values)

    # Settings ----------------------------------------------------------------------------------

    def value(self, place: Place, key: str, raw: object) -> Value:
        try:
            return self.parameters[key].check(raw)
        except ExploreError as error:
            self.fail(place, error)

    def settings(self, place: Place, table: dict[str, Any], prefix: str = "") -> dict[str, Value]:
        """Dotted keys and nested tables alike."""
        found: dict[str, Value] = {}
        for name, raw in table.items():
            key = prefix + name
            if isinstance(raw, dict) and key not in self.parameters:
                inner = self.settings((*place, name), raw, f"{key}.")
            else:
                inner = {key: self.value((*place, name), key, raw)}
            if double := found.keys() & inner.keys():
                self.fail((*place, name), f"{min(double)} is set twice")
            found |= inner
        return found

    # Sources -----------------------------------------------------------------------------------

    def sources(self) -> tuple[Source, ...]:
        kinds: dict[str, SourceKind] = {"scenes": "scene", "traces": "trace"}
        found: list[Source] = []
        for key, kind in kinds.items():
            for name in self.texts((), self.document, key):
                path = (self.path.parent / name).resolve()
                if not path.is_file():
                    self.fail((key,), f"no file {name!r} beside the spec ({path})")
                if any(source.path == path for source in found):
                    self.fail((key,), f"{name!r} is named twice")
                found.append(Source(kind, path, name))
        if not found:
            self.fail((), 'nothing to simulate; name scenes = ["…"] or traces = ["…"]')
        return tuple(found)

    # Axes --------------------------------------------------------------------------------------

    def axes(self, fixed: dict[str, Value], sampled: bool) -> tuple[Axis, ...]:
        raw = self.get((), self.document, "axis", list, [])
        axes = [self.axis(("axis", i), table, sampled) for i, table in enumerate(raw)]
        owners: dict[str, int] = {}
        names: dict[str, int] = {}
        for i, axis in enumerate(axes):
            if axis.name in names or axis.name == "scene":
                self.fail(("axis", i), f"two axes are called {axis.name!r}")
            names[axis.name] = i
            for key in axis.keys:
                if key in fixed:
                    self.fail(("axis", i), f"{key} is an axis and stands in [set] as well")
                if key in owners:
                    self.fail(("axis", i), f"{key} is set by two axes")
                owners[key] = i
        return tuple(axes)

    def axis(self, place: Place, table: Any, sampled: bool) -> Axis:
        if not isinstance(table, dict):
            self.fail(place, "write each axis as a table [[axis]]")
        self.only(place, table, {"name", "key", "values", "range", "zip", "presets"})
        forms = [form for form in ("values", "range", "zip", "presets") if form in table]
        if len(forms) != 1:
            self.fail(place, "an axis has one of values, range, zip and presets")
        name = self.get(place, table, "name", str, "")
        if forms[0] in ("values", "range"):
            return self.keyed_axis(place, table, name, sampled)
        if "key" in table:
            self.fail((*place, "key"), f"{forms[0]} names its keys itself; remove key")
        if forms[0] == "zip":
            return self.zip_axis((*place, "zip"), table["zip"], name)
        return self.preset_axis((*place, "presets"), table["presets"], name)

    def keyed_axis(self, place: Place, table: dict[str, Any], name: str, sampled: bool) -> Axis:
        key = self.get(place, table, "key", str, "")
        if not key:
            self.fail(place, 'the axis does not say what it varies; add key = "…"')
        if key not in self.parameters:
            self.value((*place, "key"), key, None)
        levels: list[Value] | Continuum
        if "range" in table:
            text = self.get(place, table, "range", str, "")
            try:
                levels = parse_range(self.parameters[key], text)
            except ExploreError as error:
                self.fail((*place, "range"), error)
            if isinstance(levels, Continuum):
                if not sampled:
                    self.fail(
                        (*place, "range"),
                        "a range without steps has no end of values; add xF, +S or [sample]",
                    )
                return Axis(name or key, (key,), continuum=levels)
        else:
            raw = self.get(place, table, "values", list, [])
            levels = [self.value((*place, "values"), key, value) for value in raw]
        self.distinct(place, levels)
        return Axis(name or key, (key,), tuple(Choice(v, {key: v}) for v in levels))

    def distinct(self, place: Place, levels: list[Value]) -> None:
        if not levels:
            self.fail(place, "the axis has no values")
        for i, level in enumerate(levels):
            if level in levels[:i]:
                self.fail(place, f"the value {level!r} stands there twice")

    def zip_axis(self, place: Place, table: Any, name: str) -> Axis:
        if not isinstance(table, dict) or not table:
            self.fail(place, 'write zip = { "key" = [values], "key" = [values] }')
        columns = self.zip_columns(place, table, "")
        lengths = {len(column) for column in columns.values()}
        if len(lengths) != 1 or 0 in lengths:
            self.fail(place, "the lists of a zip must be of one length, and not empty")
        first = next(iter(columns))
        choices = [
            Choice(columns[first][i], {key: column[i] for key, column in columns.items()})
            for i in range(lengths.pop())
        ]
        labels = [choice.label for choice in choices]
        if len(set(labels)) != len(labels):
            choices = [
                Choice(
                    ", ".join(self.parameters[k].text(v) for k, v in choice.settings.items()),
                    choice.settings,
                )
                for choice in choices
            ]
            self.distinct(place, [choice.label for choice in choices])
        return Axis(name or first, tuple(columns), tuple(choices))

    def zip_columns(
        self, place: Place, table: dict[str, Any], prefix: str
    ) -> dict[str, list[Value]]:
        columns: dict[str, list[Value]] = {}
        for part, raw in table.items():
            key = prefix + part
            if isinstance(raw, dict):
                columns |= self.zip_columns((*place, part), raw, f"{key}.")
            elif not isinstance(raw, list):
                self.fail((*place, part), f"{key} must be a list of values")
            else:
                columns[key] = [self.value((*place, part), key, value) for value in raw]
        return columns

    def preset_axis(self, place: Place, table: Any, name: str) -> Axis:
        if not name:
            self.fail(place, 'an axis of presets needs a name = "…"')
        if not isinstance(table, dict) or not table:
            self.fail(place, "write each preset as a table [axis.presets.NAME]")
        choices = []
        for label, settings in table.items():
            if not isinstance(settings, dict):
                self.fail((*place, label), f"the preset {label!r} must be a table of settings")
            choices.append(Choice(label, self.settings((*place, label), settings)))
        keys = dict.fromkeys(key for choice in choices for key in choice.settings)
        return Axis(name, tuple(keys), tuple(choices))

    # The rest ----------------------------------------------------------------------------------

    def table(self, key: str, known: set[str]) -> dict[str, Any] | None:
        if key not in self.document:
            return None
        table = self.get((), self.document, key, dict, {})
        self.only((key,), table, known)
        return cast(dict[str, Any], table)

    def sample(self) -> Sample | None:
        table = self.table("sample", {"method", "points", "seed"})
        if table is None:
            return None
        method = self.get(("sample",), table, "method", str, "latin-hypercube")
        if method not in ("random", "latin-hypercube"):
            self.fail(("sample", "method"), "method must be 'random' or 'latin-hypercube'")
        points = self.get(("sample",), table, "points", int, 0)
        if not 1 <= points <= MAX_SAMPLES:
            self.fail(("sample", "points"), f"points must be from 1 to {MAX_SAMPLES}")
        return Sample(method, points, self.get(("sample",), table, "seed", int, 1))

    def conditions(self) -> tuple[Condition, ...]:
        conditions = []
        for text in self.texts((), self.document, "drop"):
            try:
                condition = Condition(text)
                for name in sorted(condition.names):
                    self.parameters[name]  # an unknown key raises
            except ExploreError as error:
                self.fail(("drop",), error)
            conditions.append(condition)
        return tuple(conditions)

    def limits(self) -> Limits:
        table = self.table("limits", {"time", "memory", "retries"}) or {}
        seconds = parse_duration(str(table["time"])) if "time" in table else None
        if "time" in table and not seconds:
            self.fail(("limits", "time"), 'time must be a duration such as "90s", "10min" or "2h"')
        memory = parse_bytes(str(table["memory"])) if "memory" in table else None
        if "memory" in table and not memory:
            self.fail(("limits", "memory"), 'memory must be a size such as "2GiB"')
        retries = self.get(("limits",), table, "retries", int, Limits.retries)
        if not 0 <= retries <= 100:
            self.fail(("limits", "retries"), "retries must be from 0 to 100")
        return Limits(seconds, memory, retries)

    def outputs(self) -> Outputs:
        place: Place = ("outputs",)
        table = self.table("outputs", {"images", "timeline", "timeline_window"}) or {}
        images = self.get(place, table, "images", bool, Outputs.images)
        timeline = self.get(place, table, "timeline", bool, Outputs.timeline)
        window = self.get(place, table, "timeline_window", str, Outputs.timeline_window)
        if window and not timeline:
            self.fail((*place, "timeline_window"), "there is no timeline; add timeline = true")
        if window and not is_window(window):
            self.fail(
                (*place, "timeline_window"),
                'give cycles as "FIRST..END" with FIRST < END, for example "10000..20000"',
            )
        return Outputs(images, timeline, window)

    def optimize(self, axes: tuple[Axis, ...]) -> Optimize | None:
        known = {"minimize", "maximize", "budget", "batch", "seed", "fidelity"}
        table = self.table("optimize", known)
        if table is None:
            return None
        place: Place = ("optimize",)
        minimize = tuple(self.texts(place, table, "minimize"))
        maximize = tuple(self.texts(place, table, "maximize"))
        if not minimize + maximize:
            self.fail(place, "name what to minimize or maximize, such as system.cycles")
        if not axes:
            self.fail(place, "there is nothing to choose; add [[axis]]")
        budget = self.get(place, table, "budget", int, 100)
        batch = self.get(place, table, "batch", int, 8)
        if not 2 <= budget <= MAX_SAMPLES or not 1 <= batch <= budget:
            self.fail(place, f"budget must be from 2 to {MAX_SAMPLES}, batch from 1 to the budget")
        levels = self.get(place, table, "fidelity", list, [])
        fidelities = tuple(
            self.fidelity((*place, "fidelity", i), level, axes) for i, level in enumerate(levels)
        ) or (Fidelity("timed", {}, 1.0),)
        if len(fidelities) > 1 and any(level.share <= 0 for level in fidelities):
            self.fail(place, "each fidelity needs a share of the budget above 0")
        seed = self.get(place, table, "seed", int, 1)
        return Optimize(minimize, maximize, budget, batch, seed, fidelities)

    def fidelity(self, place: Place, table: Any, axes: tuple[Axis, ...]) -> Fidelity:
        if not isinstance(table, dict):
            self.fail(place, "write each fidelity as a table [[optimize.fidelity]]")
        self.only(place, table, {"name", "set", "share"})
        name = self.get(place, table, "name", str, "")
        if not name:
            self.fail(place, 'the fidelity needs a name = "…"')
        settings = self.settings((*place, "set"), self.get(place, table, "set", dict, {}))
        for key in settings:
            if any(key in axis.keys for axis in axes):
                self.fail((*place, "set"), f"{key} is an axis; a fidelity cannot set it")
        return Fidelity(name, settings, self.get(place, table, "share", float, 1.0))

    def spec(self) -> Spec:
        self.only((), self.document, _TOP)
        sample = self.sample()
        settings = self.settings(("set",), self.get((), self.document, "set", dict, {}))
        axes = self.axes(settings, sample is not None or "optimize" in self.document)
        return Spec(
            path=self.path,
            text=self.text,
            name=self.get((), self.document, "name", str, "") or self.path.stem,
            sources=self.sources(),
            settings=settings,
            axes=axes,
            sample=sample,
            drop=self.conditions(),
            replay=self.get((), self.document, "replay", bool, False),
            limits=self.limits(),
            outputs=self.outputs(),
            measures=tuple(self.texts((), self.document, "measures")),
            optimize=self.optimize(axes),
        )


def read_spec(path: Path, parameters: Parameters) -> Spec:
    """Reads and checks a spec. Raises ExploreError with file and line."""
    try:
        size = path.stat().st_size
        if size > MAX_SPEC_BYTES:
            raise ExploreError(f"{path}: is larger than a spec can be ({MAX_SPEC_BYTES} bytes)")
        text = path.read_bytes().decode("utf-8")
    except OSError as error:
        raise ExploreError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ExploreError(f"{path}: is no UTF-8 text") from None
    return _Reader(path, text, parameters).spec()
