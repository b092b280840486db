# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The plots of a report, as Vega-Lite charts."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from typing import Any

import altair as alt
import pandas as pd

from sheaf_explore.analysis import binned, pareto_front, sensitivity
from sheaf_explore.collect import Axis, Table

WIDTH, HEIGHT = 460, 300
_LABELS = 160  # of the width, for the names of measures
_SCALE_DOWN = {"bits": (8 * 1024, "KiB"), "bytes": (1024, "KiB")}
# Colours that people with colour-blindness tell apart (Okabe and Ito 2008).
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999"]
_SMALLEST_SHARE = 0.001  # of variance, below which an axis is not drawn
_WIDE = 20  # ratio from which a cost is drawn on a logarithmic scale
_SHORT = alt.Axis(  # 2.5M and 0.95, where one format would give 2500000 or 950m
    labelExpr="format(datum.value, abs(datum.value) >= 1000 ? '~s' : '.4~g')"
)

_ENERGY = "energy.known"
_PARETO_COSTS = ("derived.sram_bits", "derived.dram_bytes", _ENERGY)
_DEFAULT_MEASURES = (
    "system.cycles",
    "derived.dram_bytes",
    "trace.secondary.p_t",
    "system.ray_cache.hit_rate",
)


@dataclass(frozen=True)
class Plot:
    """A chart with its file name, heading and explanation."""

    name: str
    title: str
    text: str
    chart: Any


def _file(name: str) -> str:
    """A name that is a file's everywhere."""
    return re.sub(r"[^A-Za-z0-9._-]", "_", name)


def _with_names_of_their_own(plots: list[Plot]) -> list[Plot]:
    """The plots, numbered where two would be the same file."""
    seen: dict[str, int] = {}
    named = []
    for plot in plots:
        count = seen[plot.name] = seen.get(plot.name, 0) + 1
        named.append(plot if count == 1 else replace(plot, name=f"{plot.name}-{count}"))
    return named


def measures_of(table: Table) -> list[str]:
    """What the report shows first: as the spec says, or what most sweeps ask."""
    counters = set(table.counters())
    chosen = [measure for measure in table.measures if measure in counters]
    if chosen:
        return chosen
    usual = [measure for measure in _DEFAULT_MEASURES if measure in counters]
    return [m for m in usual if table.frame[m].nunique() > 1] or sorted(counters)[:1]


def varying(table: Table) -> list[str]:
    """Counters that are not the same at all points."""
    return [c for c in table.counters() if table.frame[c].nunique(dropna=False) > 1]


def importance(table: Table, measure: str) -> dict[str, float]:
    """The share of a measure's variance that each axis explains alone."""
    shares = {}
    for axis in table.axes:
        places = table.frame.assign(_axis=binned(table.frame[axis.name]).astype(str))
        share = sensitivity(places, "_axis", measure)
        if share is not None:
            shares[axis.name] = share
    return shares


def _label_of(axis: Axis) -> dict[Any, str]:
    return dict(zip(axis.values, axis.labels, strict=True))


def labelled(table: Table, axis: Axis) -> list[str]:
    """The axis column in words."""
    names = _label_of(axis)
    return [names.get(value, str(value)) for value in table.frame[axis.name]]


def _axis_title(table: Table, measure: str) -> str:
    unit = table.units.get(measure, "")
    return f"{measure} [{unit}]" if unit not in ("", "1", "text") else measure


def _hues(axis: Axis) -> list[str]:
    """Colours of an axis: distinct ones, or for more than eight places a ramp."""
    if len(axis.labels) <= len(COLOURS):
        return COLOURS[: len(axis.labels)]
    return []


def _below() -> alt.Legend:
    """A legend that leaves the plot its width."""
    return alt.Legend(orient="bottom", columns=4, labelLimit=120)


def _colour(axis: Axis | None, present: set[str]) -> Any:
    if axis is None:
        return alt.value(COLOURS[0])
    domain = [label for label in axis.labels if label in present]
    hues = _hues(axis)
    scale = (
        alt.Scale(domain=domain, range=hues[: len(domain)])
        if hues
        else alt.Scale(domain=domain, scheme="viridis")
    )
    return alt.Color("colour:N", title=axis.name, scale=scale, sort=domain, legend=_below())


def axis_plot(table: Table, axis: Axis, measure: str) -> Plot:
    """A measure along an axis: a dot a point, lines through means, by the next strongest axis."""
    shares = {name: s for name, s in importance(table, measure).items() if name != axis.name}
    strongest = max(shares, key=lambda name: shares[name], default=None)
    other = next((a for a in table.axes if a.name == strongest), None)
    data = pd.DataFrame(
        {
            "x": labelled(table, axis),
            "y": table.frame[measure].astype(float),
            "colour": labelled(table, other) if other else "",
            "point": table.frame["point"],
        }
    )
    order = [label for label in axis.labels if label in set(data["x"])]
    colour = _colour(other, set(data["colour"]))
    numeric = len(axis.labels) > 12 and pd.api.types.is_numeric_dtype(table.frame[axis.name].dtype)
    if numeric:
        data["x"] = table.frame[axis.name].astype(float)
        x = alt.X("x:Q", title=axis.name, scale=alt.Scale(zero=False), axis=_SHORT)
    else:
        room = max(40, WIDTH // max(len(order), 1) - 6)
        x = alt.X("x:N", sort=order, title=axis.name, axis=alt.Axis(labelAngle=0, labelLimit=room))
    y = alt.Y("y:Q", title=_axis_title(table, measure), scale=alt.Scale(zero=False), axis=_SHORT)
    base = alt.Chart(data).encode(x=x, color=colour)
    dots = base.mark_circle(size=28, opacity=0.45).encode(
        y=y, tooltip=["point:N", "x:N", "y:Q", "colour:N"]
    )
    layers = [dots]
    if not numeric:
        layers.insert(0, base.mark_line(strokeWidth=2).encode(y=alt.Y("mean(y):Q")))
    text = "A dot is a point" + ("" if numeric else "; lines join means")
    if other:
        text += f"; coloured by {other.name}, the other axis that matters most to it"
    chart = alt.layer(*layers).properties(width=WIDTH, height=HEIGHT)
    return Plot(
        _file(f"{measure}-by-{axis.name}"), f"{measure} along {axis.name}", text + ".", chart
    )


def pareto_plot(table: Table, cost: str, against: str) -> Plot:
    """One measure against a cost, smaller is better for both, a front for each scene."""
    unit = table.units.get(cost, "")
    scale, shown = _SCALE_DOWN.get(unit, (1, unit))
    place = (
        table.frame[[axis.name for axis in table.axes]].astype(str).agg(", ".join, axis=1)
        if table.axes
        else ""
    )
    data = pd.DataFrame(
        {
            "x": table.frame[cost].astype(float) / scale,
            "y": table.frame[against].astype(float),
            "scene": [name.rsplit("/", 1)[-1] for name in table.frame["scene"]],
            "point": table.frame["point"],
            "place": place,
        }
    ).dropna(subset=["x", "y"])
    data["front"] = False
    for _, rows in data.groupby("scene"):
        data.loc[rows.index, "front"] = pareto_front(rows[["x", "y"]].to_numpy(dtype=float))
    wide = data["x"].min() > 0 and data["x"].max() > _WIDE * data["x"].min()
    x = alt.X(
        "x:Q",
        title=f"{cost} [{shown}]" if shown else cost,
        scale=alt.Scale(type="log", nice=False) if wide else alt.Scale(zero=False),
        axis=alt.Axis(format=",.6~g", labelOverlap=True),
    )
    y = alt.Y("y:Q", title=_axis_title(table, against), scale=alt.Scale(zero=False), axis=_SHORT)
    legend = _below() if data["scene"].nunique() > 1 else None
    colour = alt.Color("scene:N", scale=alt.Scale(range=COLOURS), legend=legend)
    tooltip = ["point:N", "place:N", "scene:N", "x:Q", "y:Q"]
    base = alt.Chart(data).encode(x=x, y=y, color=colour, tooltip=tooltip)
    front = base.transform_filter("datum.front")
    chart = alt.layer(
        base.mark_circle(size=26, opacity=0.3),
        front.mark_line(interpolate="step-after", strokeWidth=1.5),
        front.mark_point(size=60, filled=True, opacity=1),
    ).properties(width=WIDTH, height=HEIGHT)
    count = int(data["front"].sum())
    text = f"{count} of {len(data)} points are on the front: no other is better in both."
    return Plot(_file(f"pareto-{cost}"), f"{against} against {cost}", text, chart)


def pareto_plots(table: Table) -> tuple[list[Plot], list[str]]:
    """Cycles against what machines cost, and what could not be drawn, with the reason."""
    against = "system.cycles"
    counters = set(table.counters())
    if against not in counters:
        return [], [f"No Pareto fronts: the points have no {against}."]
    costs = [cost for cost in _PARETO_COSTS if cost in counters]
    notes: list[str] = []
    if _ENERGY not in costs:
        notes.append("Energy: the simulator that ran this sweep does not report it.")
    plots: list[Plot] = []
    for cost in costs:
        if table.frame[cost].nunique() > 1:
            plots.append(pareto_plot(table, cost, against))
        else:
            notes.append(f"{cost} is the same at all points, so it has no front.")
    return plots, notes


def sensitivity_plot(table: Table, measures: list[str]) -> Plot | None:
    """How much of each measure's spread each axis explains alone."""
    rows = []
    for measure in measures:
        shares = importance(table, measure)
        rows += [{"measure": measure, "axis": name, "share": s} for name, s in shares.items()]
        rest = 1 - sum(shares.values())
        if shares and rest > 0.005:
            rows.append({"measure": measure, "axis": "interactions", "share": rest})
    if not rows:
        return None
    names = [axis.name for axis in table.axes] + ["interactions"]
    colours = [*COLOURS[: len(names) - 1], "#dddddd"]
    chart = (
        alt.Chart(pd.DataFrame(rows))
        .mark_bar()
        .encode(
            x=alt.X("sum(share):Q", title="share of variance", axis=alt.Axis(format="%")),
            y=alt.Y("measure:N", sort=measures, title=None, axis=alt.Axis(labelLimit=_LABELS + 40)),
            color=alt.Color(
                "axis:N",
                sort=names,
                scale=alt.Scale(domain=names, range=colours),
                title="axis",
                legend=_below(),
            ),
            order=alt.Order("rank:Q"),
            tooltip=["measure:N", "axis:N", alt.Tooltip("share:Q", format=".1%")],
        )
        .transform_calculate(rank=f"indexof({json.dumps(names)}, datum.axis)")
        .properties(width=WIDTH - _LABELS, height=34 * len({row["measure"] for row in rows}))
    )
    text = (
        "The share of a measure's variance that each axis explains alone (first-order Sobol index);"
        " interactions are what no single axis explains."
    )
    return Plot("sensitivity", "Sensitivity", text, chart)


def explorer(table: Table, most_values: int = 600_000) -> Plot:
    """Any axis against any counter, chosen in the page."""
    counters = varying(table)
    notes = ""
    room = max(most_values // max(len(table.frame), 1), 8)
    if len(counters) > room:
        first = [m for m in measures_of(table) if m in counters]
        counters = list(dict.fromkeys(first + counters))[:room]
        notes = f" Of the counters that vary the first {room} can be chosen; all are in the table."
    axes = [axis.name for axis in table.axes]
    columns: dict[str, Any] = {name: table.frame[name] for name in ("point", "scene")}
    columns |= {name: table.frame[name].astype(float) for name in counters}
    columns |= {axis.name: labelled(table, axis) for axis in table.axes}
    data = pd.DataFrame(columns)
    all_names = [*axes, *counters]
    start = measures_of(table)
    y_first = start[0] if start and start[0] in counters else (counters or all_names)[0]
    order = {axis.name: axis.labels for axis in table.axes}
    ranks = json.dumps(order)

    def choose(name: str, options: list[str], value: str) -> Any:
        return alt.param(
            name=name, value=value, bind=alt.binding_select(options=options, name=f"{name} ")
        )

    x = choose("across", axes or all_names, (axes or all_names)[0])
    y = choose("up", counters or all_names, y_first)
    hue = choose("colour", [*axes, "scene"], (axes[1:] or ["scene"])[0])
    chart = (
        alt.Chart(data)
        .mark_circle(size=50, opacity=0.6)
        .transform_calculate(
            x="datum[across]",
            y="datum[up]",
            hue="datum[colour]",
            rank=f"indexof(({ranks})[across] || [], datum[across])",
        )
        .encode(
            x=alt.X("x:N", title=None, sort=alt.EncodingSortField("rank", op="min")),
            y=alt.Y("y:Q", title=None, scale=alt.Scale(zero=False), axis=_SHORT),
            color=alt.Color(
                "hue:N", title=None, sort=[label for axis in table.axes for label in axis.labels]
            ),
            tooltip=["point:N", "scene:N", "x:N", "y:Q", "hue:N"],
        )
        .add_params(x, y, hue)
        .properties(width=680, height=360)
    )
    return Plot("explorer", "Any axis against any counter", "Choose below the plot." + notes, chart)


def all_plots(table: Table) -> tuple[list[Plot], list[str]]:
    """Every plot that goes to a file too, and notes on those that could not be drawn."""
    measures = measures_of(table)
    plots: list[Plot] = []
    flat = []
    for measure in measures:
        shares = importance(table, measure)
        for axis in table.axes:
            if shares.get(axis.name, 0.0) >= _SMALLEST_SHARE:
                plots.append(axis_plot(table, axis, measure))
            elif table.frame[axis.name].nunique() > 1:
                flat.append(f"{measure} along {axis.name}")
    fronts, notes = pareto_plots(table)
    if flat:
        notes.append(f"Not drawn, because the axis alone changes nothing: {'; '.join(flat)}.")
    sensitivities = sensitivity_plot(table, measures)
    everything = [*plots, *fronts, *([sensitivities] if sensitivities else [])]
    return _with_names_of_their_own(everything), notes
