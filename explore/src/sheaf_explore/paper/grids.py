# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Tables for people: rows of names and of cells that hold our figure and the paper's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import pandas as pd

from sheaf_explore.paper.hardware import Verdict
from sheaf_explore.paper.plan import HEURISTICS, LEVELS, PACKET_SIZES, USUAL_MEMORY

_NEAR, _FAR = 0.15, 0.5  # relative differences, for the shade of a cell


@dataclass(frozen=True)
class Cell:
    """One figure, as text."""

    ours: str
    paper: str = ""
    difference: str = ""
    shade: str = ""


@dataclass(frozen=True)
class Row:
    labels: tuple[str, ...]
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Grid:
    """A table: `labels` columns of names, then cells, in `groups` of so many columns each."""

    columns: tuple[str, ...]
    labels: int
    rows: tuple[Row, ...]
    groups: tuple[tuple[str, int], ...] = ()

    @property
    def every(self) -> int:
        """Columns of a group, 0 without groups."""
        return self.groups[0][1] if self.groups else 0


def number(value: float, digits: int = 3) -> str:
    """A figure at so many significant digits; nothing if there is none."""
    if math.isnan(value):
        return ""
    if abs(value) >= 10**digits:
        return f"{value:,.0f}"
    return f"{value:#.{digits}g}".rstrip(".")


def percent(value: float) -> str:
    """A relative difference with its sign."""
    if math.isnan(value):
        return ""
    text = f"{value:+.0%}".replace("-", "−")
    return "0%" if text[1:] == "0%" else text


def compared(ours: float, paper: float, difference: float | None = None) -> Cell:
    """Our figure with the paper's, shaded by the relative difference."""
    if difference is None:
        difference = ours / paper - 1 if paper else math.nan
    shade = ""
    if not math.isnan(difference):
        off = abs(difference)
        shade = "#e6f4ea" if off <= _NEAR else "#fbe9e5" if off > _FAR else ""
    return Cell(number(ours), number(paper), percent(difference), shade)


def _cell(frame: pd.DataFrame, **where: Any) -> Cell:
    """The one row of a table of figures where columns have these values."""
    chosen = frame
    for column, value in where.items():
        chosen = chosen[chosen[column] == value]
    if chosen.empty:
        return Cell("")
    row = chosen.iloc[0]
    return compared(float(row["ours"]), float(row["paper"]))


def _records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    """The rows of a table."""
    return [{str(name): value for name, value in row.items()} for row in frame.to_dict("records")]


def _scenes(frame: pd.DataFrame) -> list[str]:
    return list(dict.fromkeys(frame["scene"]))


def table1(frame: pd.DataFrame) -> Grid:
    """Frames per second, and relative to none."""
    rows = []
    for row in _records(frame):
        rate = Cell(number(row["ours"]), number(row["paper"], 2))
        relative = compared(row["ours_relative"], row["paper_relative"])
        rows.append(Row((row["scene"], row["heuristic"]), (rate, relative)))
    columns = ("scene", "heuristic", "frames per second", "relative to none")
    return Grid(columns, 2, tuple(rows))


def table2(frame: pd.DataFrame) -> Grid:
    """c_t, p_t and p_t / size by size of packets."""
    rows = []
    for scene in _scenes(frame):
        part = frame[frame["scene"] == scene]
        rows += [
            Row((scene, m), tuple(_cell(part, measure=m, packet_size=s) for s in PACKET_SIZES))
            for m in ("c_t", "p_t")
        ]
        p_t = part[part["measure"] == "p_t"].set_index("packet_size")
        share = tuple(
            compared(p_t["ours"].get(s, math.nan) / s, p_t["paper"].get(s, math.nan) / s)
            for s in PACKET_SIZES
        )
        rows.append(Row((scene, "p_t / size"), share))
    return Grid(("scene", "", *map(str, PACKET_SIZES)), 2, tuple(rows))


def table3(frame: pd.DataFrame) -> Grid:
    """c_t and p_t by traversal."""
    keys = frame[["scene", "rays", "traversal"]].drop_duplicates()
    rows = tuple(
        Row(
            (k["scene"], k["rays"], k["traversal"]),
            tuple(_cell(frame, measure=m, **k) for m in ("c_t", "p_t")),
        )
        for k in _records(keys.sort_values(["scene", "rays"], kind="stable"))
    )
    return Grid(("scene", "rays", "traversal", "c_t", "p_t"), 3, rows)


def table4(frame: pd.DataFrame, measures: tuple[str, ...] = ("c_t", "p_t", "c_i", "p_i")) -> Grid:
    """Measures by scene, heuristic and level."""
    rows = tuple(
        Row(
            (scene, heuristic),
            tuple(
                _cell(part, heuristic=heuristic, level=level, measure=measure)
                for level in LEVELS
                for measure in measures
            ),
        )
        for scene in _scenes(frame)
        for part in [frame[frame["scene"] == scene]]
        for heuristic in HEURISTICS
    )
    groups = tuple((f"level {level}", len(measures)) for level in LEVELS)
    return Grid(("scene", "heuristic", *measures * len(LEVELS)), 2, rows, groups)


def ranks(frame: pd.DataFrame) -> Grid:
    """Rank correlations by scene and level."""
    rows = tuple(
        Row(
            (row["scene"], str(row["level"])),
            (
                Cell(number(row["spearman"], 2)),
                Cell(number(row["kendall"], 2)),
                Cell(number(row["spread_ours"]), number(row["spread_paper"])),
            ),
        )
        for row in _records(frame)
    )
    columns = ("scene", "level", "Spearman's ρ", "Kendall's τ", "best p_t over worst")
    return Grid(columns, 2, rows)


def sway(frame: pd.DataFrame) -> Grid:
    """Mean and extreme changes by variant."""
    rows = tuple(
        Row(
            (row["group"], row["variant"], row["measure"]),
            tuple(Cell(percent(x)) for x in (row["mean"], row["min"], row["max"])),
        )
        for row in _records(frame)
    )
    return Grid(("", "variant", "measure", "mean", "least", "most"), 3, rows)


def anchors(frame: pd.DataFrame) -> Grid:
    """p_t of pos(x) by x."""
    xs = sorted(set(frame["x"]))
    rows = tuple(
        Row(
            (scene,),
            tuple(
                Cell(number(float(part[part["x"] == x]["ours"].iloc[0])))
                for x in xs
                for part in [frame[frame["scene"] == scene]]
            ),
        )
        for scene in _scenes(frame)
    )
    return Grid(("scene", *(f"x = {x:g}" for x in xs)), 1, rows)


def verdicts(found: list[Verdict]) -> Grid:
    """The best sorting by scene and memory."""
    rows = tuple(
        Row(
            (v.scene, v.memory, v.best, "yes" if v.pays else "no"),
            tuple(Cell(number(x)) for x in (v.time, v.traffic, v.energy)),
        )
        for v in found
    )
    columns = ("scene", "memory", "best sorting", "pays in time")
    return Grid((*columns, "time", "DRAM bytes", "energy"), 4, rows)


def sram(machines: pd.DataFrame) -> Grid:
    """What each sorting takes in SRAM; areas are the same for all scenes."""
    usual = machines[machines["memory"] == USUAL_MEMORY]
    once = usual.drop_duplicates("sorting")
    columns = ("ray_cache_kib", "ray_cache_area", "area", "area_relative")
    rows = tuple(
        Row((row["sorting"],), tuple(Cell(number(row[column])) for column in columns))
        for row in _records(once)
    )
    names = ("sorting", "ray cache, KiB", "ray cache, mm²", "all SRAM, mm²", "none = 1")
    return Grid(names, 1, rows)
