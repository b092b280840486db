# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""One wide table of a sweep: a row a point, a column a setting, a counter or a derived value."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from sheaf_explore.derived import derive
from sheaf_explore.errors import ExploreError
from sheaf_explore.store import Store, write_whole


@dataclass(frozen=True)
class Axis:
    """An axis of the collected sweep: its column, and its places in order with their names."""

    name: str
    values: list[Any]
    labels: list[str]
    unit: str


@dataclass(frozen=True)
class Failure:
    """A point without a result."""

    point: str
    place: str
    kind: str
    message: str


@dataclass(frozen=True)
class Table:
    """A collected sweep. `units` has the unit of each column that has one."""

    name: str
    frame: pd.DataFrame
    units: dict[str, str]
    axes: list[Axis]
    measures: list[str]
    settings: frozenset[str]
    failures: list[Failure]
    total: int

    def counters(self) -> list[str]:
        """Columns of numbers that came out of the simulations."""
        given = {"point", "scene", "mode"} | self.settings
        return [
            column
            for column in self.frame.columns
            if column not in given and pd.api.types.is_numeric_dtype(self.frame[column].dtype)
        ]

    def write(self, folder: Path) -> Path:
        """Writes results.parquet, results.csv and columns.csv; same points, same bytes."""
        arrow = pa.Table.from_pandas(self.frame, preserve_index=False)
        fields = [
            field.with_metadata({"unit": self.units.get(field.name, "")}) for field in arrow.schema
        ]
        sink = io.BytesIO()
        pq.write_table(arrow.cast(pa.schema(fields)).replace_schema_metadata(None), sink)
        parquet = folder / "results.parquet"
        write_whole(parquet, sink.getvalue())
        write_whole(folder / "results.csv", self.frame.to_csv(index=False, lineterminator="\n"))
        units = io.StringIO()
        writer = csv.writer(units, lineterminator="\n")
        writer.writerow(["column", "unit"])
        writer.writerows([column, self.units.get(column, "")] for column in self.frame.columns)
        write_whole(folder / "columns.csv", units.getvalue())
        return parquet


def _row(store: Store, entry: dict[str, Any], sweep: dict[str, Any]) -> dict[str, tuple[Any, str]]:
    """Columns of one finished point with their units."""
    counters = store.stats(entry["id"])
    values = {name: field["value"] for name, field in counters.items()}
    row: dict[str, tuple[Any, str]] = {
        "point": (entry["id"], ""),
        "scene": (entry["scene"], ""),
        "mode": (entry["mode"], ""),
    }
    row |= {name: (_plain(label), "") for name, label in entry["labels"].items()}
    settings = sweep["defaults"] | entry["settings"]
    row |= {key: (_plain(settings[key]), "") for key in sweep["meanings"]}
    row |= derive(values)
    for name, field in counters.items():
        column = f"stats.{name}" if name in row else name
        row[column] = (field["value"], field["unit"])
    return row


def _plain(value: Any) -> Any:
    return str(value) if isinstance(value, list) else value


def _series(values: list[Any]) -> pd.Series:
    """A column of one type: whole numbers, numbers or text."""
    known = [value for value in values if value is not None]
    if all(isinstance(value, bool) for value in known):
        return pd.Series(values, dtype="boolean")
    if all(isinstance(value, int) and not isinstance(value, bool) for value in known):
        return pd.Series(values, dtype="Int64")
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in known):
        return pd.Series(values, dtype="Float64")
    return pd.Series([None if v is None else str(v) for v in values], dtype="string")


def collect(store: Store) -> Table:
    """Reads every point of the last spec. Raises ExploreError if there is no result at all."""
    sweep = store.sweep()
    rows = []
    failures = []
    for entry in sweep["points"]:
        if store.is_done(entry["id"]):
            rows.append(_row(store, entry, sweep))
        elif failure := store.failure(entry["id"]):
            place = ", ".join([entry["scene"], *(f"{k}={v}" for k, v in entry["labels"].items())])
            failures.append(Failure(entry["id"], place, failure["kind"], failure["message"]))
    if not rows:
        raise ExploreError(f"{store.folder}: no point has a result yet; run `explore sweep` first")
    columns = list(dict.fromkeys(name for row in rows for name in row))
    none: tuple[Any, str] = (None, "")
    data = {c: _series([row.get(c, none)[0] for row in rows]) for c in columns}
    units: dict[str, str] = {}
    for row in rows:
        units |= {name: unit for name, (_, unit) in row.items()}
    units |= {axis["name"]: axis["unit"] for axis in sweep["axes"]}
    return Table(
        name=sweep["name"],
        frame=pd.DataFrame(data),
        units=units,
        axes=_axes(sweep, data),
        measures=sweep["measures"],
        settings=frozenset(
            name for entry in sweep["points"] for name in [*entry["labels"], *entry["settings"]]
        ),
        failures=failures,
        total=len(sweep["points"]),
    )


def _axes(sweep: dict[str, Any], data: dict[str, pd.Series]) -> list[Axis]:
    """The axes, the scene first if there are several; a sampled range has the values drawn."""
    axes = []
    scenes = list(dict.fromkeys(entry["scene"] for entry in sweep["points"]))
    if len(scenes) > 1:
        axes.append(Axis("scene", scenes, [Path(s).name for s in scenes], ""))
    for axis in sweep["axes"]:
        values = [_plain(value) for value in axis["values"]]
        labels = axis["labels"]
        if not values:
            values = sorted(data[axis["name"]].dropna().unique().tolist())
            labels = [
                f"{value:.4g}" if isinstance(value, float) else str(value) for value in values
            ]
        axes.append(Axis(axis["name"], values, labels, axis["unit"]))
    return axes
