# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The plots of the paper's report.

The paper's figures 2, 5, 6 and 7 are drawn from what its tables print: their own values are not
published as numbers.
"""

from __future__ import annotations

from typing import Any

import altair as alt
import pandas as pd

from sheaf_explore.charts import COLOURS, Plot
from sheaf_explore.paper.plan import HEURISTICS, MEMORIES, PACKET_SIZES

_WIDE, _HIGH = 360, 260
_SOURCES = ["ours", "paper"]
_SOURCE = "who:N"
_ROW = 780  # width of a row of panels


def _both(frame: pd.DataFrame, keys: list[str], once: bool = False) -> pd.DataFrame:
    """Our rows and the paper's below each other, where there is a number.

    With `once` the paper's stand beside the stand-in alone, not beside the real model as well.
    """
    names = [*keys, "stands_for"]
    long = frame.melt(names, ["ours", "paper"], var_name="who", value_name="value")
    known = long.dropna(subset=["value"])
    twice = (known["who"] == "paper") & (known["scene"] != known["stands_for"])
    return known[~twice] if once else known


def _order(frame: pd.DataFrame, column: str) -> list[Any]:
    return list(dict.fromkeys(frame[column]))


def _colour(field: str, order: list[str], title: str) -> Any:
    scale = alt.Scale(domain=order, range=COLOURS[: len(order)])
    return alt.Color(f"{field}:N", title=title, scale=scale, legend=alt.Legend(orient="bottom"))


def _dash() -> Any:
    return alt.StrokeDash(
        _SOURCE,
        title="",
        scale=alt.Scale(domain=_SOURCES, range=[[1, 0], [4, 3]]),
        legend=alt.Legend(orient="bottom", symbolStrokeColor="#444"),
    )


def _lines(data: pd.DataFrame, x: Any, title: str, log: bool = False) -> Any:
    """A line a scene, ours solid and the paper's dashed."""
    y = alt.Y("value:Q", title=title, scale=alt.Scale(type="log") if log else alt.Scale(zero=True))
    colour = _colour("scene", _order(data, "scene"), "")
    base = alt.Chart(data).encode(x=x, y=y, color=colour)
    tooltip = ["scene:N", _SOURCE, alt.Tooltip("value:Q", format=".3~g")]
    return alt.layer(
        base.mark_line(strokeWidth=2).encode(strokeDash=_dash()),
        base.mark_point(filled=True, size=36).encode(tooltip=tooltip),
    ).properties(width=_WIDE, height=_HIGH)


def figure2(table4: pd.DataFrame) -> Plot:
    """Coherence of the rays along the recursion level."""
    chosen = table4[(table4["heuristic"] == "none") & table4["measure"].isin(["c_t", "c_i"])]
    data = _both(chosen, ["scene", "level", "measure"], once=True)
    panels = [
        _lines(
            data[data["measure"] == measure],
            alt.X("level:O", title="recursion level", axis=alt.Axis(labelAngle=0)),
            measure,
        )
        for measure in ("c_t", "c_i")
    ]
    return Plot(
        "paper-figure2",
        "Figure 2: coherence of secondary rays along the recursion level",
        "Visits by the rays of a tile for each distinct inner node (c_t) or triangle (c_i). Solid: "
        "here; dashed: the paper's table 4.",
        alt.hconcat(*panels, spacing=30),
    )


def figure5(table4: pd.DataFrame) -> Plot:
    """p_t of each heuristic, a panel a scene and level."""
    chosen = table4[table4["measure"] == "p_t"]
    data = _both(chosen, ["scene", "level", "heuristic"])
    scenes = _order(data, "scene")
    base = alt.Chart(data).encode(
        x=alt.X("value:Q", title="p_t", scale=alt.Scale(zero=False)),
        y=alt.Y("heuristic:N", sort=list(HEURISTICS), title=None),
        color=alt.Color(
            _SOURCE,
            title="",
            sort=_SOURCES,
            scale=alt.Scale(domain=_SOURCES, range=COLOURS[:2]),
            legend=alt.Legend(orient="bottom"),
        ),
        shape=alt.Shape(
            _SOURCE,
            title="",
            scale=alt.Scale(domain=_SOURCES, range=["circle", "diamond"]),
        ),
        tooltip=[
            "scene:N",
            "level:O",
            "heuristic:N",
            _SOURCE,
            alt.Tooltip("value:Q", format=".3~g"),
        ],
    )
    chart = (
        base.mark_point(size=45, filled=True, opacity=0.85)
        .properties(width=_ROW // len(scenes), height=96)
        .facet(
            column=alt.Column("scene:N", sort=scenes, title=None),
            row=alt.Row("level:O", title="recursion level"),
        )
        .resolve_scale(x="independent")
    )
    return Plot(
        "paper-figure5",
        "Figure 5: p_t of secondary rays by heuristic",
        "What the paper's table 4 prints, as dots; each panel has its own scale, since the order "
        "within a panel is what is to be compared.",
        chart,
    )


def _along_size(table2: pd.DataFrame, title: str, log: bool) -> Any:
    data = _both(table2, ["scene", "packet_size"], once=True)
    x = alt.X(
        "packet_size:Q",
        title="rays of a packet",
        scale=alt.Scale(type="log", base=2, nice=False),
        axis=alt.Axis(values=list(PACKET_SIZES)),
    )
    return _lines(data, x, title, log)


def figures_6_and_7(table2: pd.DataFrame) -> list[Plot]:
    """p_t, and p_t for each ray of a packet, along the size of packets."""
    p_t = table2[table2["measure"] == "p_t"]
    share = p_t.assign(
        ours=p_t["ours"] / p_t["packet_size"], paper=p_t["paper"] / p_t["packet_size"]
    )
    how = "Without sorting, recursion level 1. Solid: here; dashed: the paper's table 2."
    return [
        Plot(
            "paper-figure6",
            "Figure 6: p_t along the size of packets",
            how,
            _along_size(p_t, "p_t", log=False),
        ),
        Plot(
            "paper-figure7",
            "Figure 7: p_t / size along the size of packets",
            how + " One would be a packet whose rays visit the same nodes.",
            _along_size(share, "p_t / size", log=False),
        ),
    ]


def gains_plot(gains: pd.DataFrame) -> Plot:
    """What sorting gains here against what it gains in the paper."""
    data = gains[gains["heuristic"] != "none"].dropna(subset=["ours", "paper"])
    values = [*data["ours"], *data["paper"], 0.9, 1.1]
    domain = [min(values) - 0.02, max(values) + 0.02]
    line = pd.DataFrame({"x": domain, "y": domain})
    axis = alt.Scale(domain=domain, nice=False)
    order = [h for h in HEURISTICS if h != "none"]
    dots = (
        alt.Chart(data)
        .mark_point(filled=True, size=50, opacity=0.8)
        .encode(
            x=alt.X("paper:Q", title="p_t over that of none, paper", scale=axis),
            y=alt.Y("ours:Q", title="p_t over that of none, here", scale=axis),
            color=_colour("heuristic", order, ""),
            shape=alt.Shape("level:N", title="level", legend=alt.Legend(orient="bottom")),
            tooltip=["scene:N", "level:O", "heuristic:N", "ours:Q", "paper:Q"],
        )
    )
    equal = (
        alt.Chart(line)
        .mark_line(color="#bbb", strokeDash=[4, 4])
        .encode(x=alt.X("x:Q", scale=axis), y=alt.Y("y:Q", scale=axis))
    )
    chart = alt.layer(equal, dots).properties(width=_WIDE + 60, height=_WIDE)
    return Plot(
        "paper-gains",
        "What sorting gains, here and in the paper",
        "p_t divided by that of none, which leaves out how coherent a scene is as a whole. On the "
        "line both gain the same.",
        chart,
    )


def sway_plot(sway: pd.DataFrame) -> Plot:
    """How measures move with what the paper does not print."""
    data = sway[sway["group"] != "as designed"].copy()
    data["where"] = data["group"] + ": " + data["variant"]
    order = _order(data, "where")
    panels = []
    for measure in ("p_t", "c_t"):
        chosen = data[data["measure"] == measure]
        base = alt.Chart(chosen).encode(
            y=alt.Y("where:N", sort=order, title=None, axis=alt.Axis(labelLimit=240, labels=True)),
            x=alt.X("change:Q", title=f"change of {measure}", axis=alt.Axis(format="+%")),
        )
        dots = base.mark_point(filled=True, opacity=0.65, size=40).encode(
            color=_colour("heuristic", list(HEURISTICS), ""),
            tooltip=["scene:N", "where:N", "heuristic:N", alt.Tooltip("change:Q", format="+.1%")],
        )
        panels.append(
            dots.properties(width=330, height=24 * max(1, chosen["where"].nunique()), title=measure)
        )
    return Plot(
        "paper-sway",
        "How far p_t and c_t move with what the paper does not print",
        "A dot is a scene and a heuristic at recursion level 2, against the design's choice: tiles "
        "of 16 × 16, K_T = 15, K_I = 20, bonus 0.8 for empty space, kinds in order of arrival.",
        alt.hconcat(*panels, spacing=20),
    )


def _by_sorting(machines: pd.DataFrame, column: str, title: str) -> Any:
    memories = [m for m in MEMORIES if m in set(machines["memory"])]
    sortings = _order(machines, "sorting")
    scenes = _order(machines, "scene")
    data = machines.dropna(subset=[column])
    base = alt.Chart(data).encode(
        x=alt.X(f"{column}:Q", title=title, scale=alt.Scale(zero=False)),
        y=alt.Y("sorting:N", sort=sortings, title=None),
    )
    one = alt.Chart(data).mark_rule(color="#999", strokeDash=[3, 3]).encode(x=alt.datum(1.0))
    dots = base.mark_point(filled=True, size=55, opacity=0.85).encode(
        color=_colour("scene", scenes, ""),
        tooltip=["scene:N", "memory:N", "sorting:N", alt.Tooltip(f"{column}:Q", format=".3f")],
    )
    return (
        alt.layer(one, dots, data=data)
        .properties(width=215, height=24 * len(sortings))
        .facet(column=alt.Column("memory:N", sort=memories, title=None))
    )


def _by_size(machines: pd.DataFrame) -> Plot:
    """Time along the size of the ray cache, by heuristic and memory."""
    sorted_ = machines[machines["heuristic"] != "none"]
    keys = ["memory", "heuristic", "ray_cache_kib"]
    data = sorted_.groupby(keys, sort=False)["cycles_relative"].mean().reset_index()
    base = alt.Chart(data).encode(
        x=alt.X(
            "ray_cache_kib:Q",
            title="ray cache, KiB",
            scale=alt.Scale(type="log", base=2, nice=False, padding=12),
            axis=alt.Axis(values=[4, 8, 16, 32, 64]),
        ),
        y=alt.Y("cycles_relative:Q", title="cycles, none = 1", scale=alt.Scale(zero=False)),
        color=_colour("heuristic", _order(data, "heuristic"), ""),
    )
    dots = base.mark_point(filled=True, size=60, opacity=0.9).encode(
        tooltip=["heuristic:N", "ray_cache_kib:Q", alt.Tooltip("cycles_relative:Q", format=".3f")]
    )
    one = alt.Chart(data).mark_rule(color="#999", strokeDash=[3, 3]).encode(y=alt.datum(1.0))
    memories = [m for m in MEMORIES if m in set(data["memory"])]
    chart = (
        alt.layer(one, base.mark_line(strokeWidth=1.5), dots, data=data)
        .properties(width=200, height=200)
        .facet(column=alt.Column("memory:N", sort=memories, title=None))
    )
    text = "Mean over the scenes, against the machine without sorting. Less is better."
    return Plot("paper-size", "Length of the frame along the size of the ray cache", text, chart)


def hardware_plots(machines: pd.DataFrame) -> list[Plot]:
    """Time, traffic and energy of sorting machines against the machine that does not sort."""
    shown = [
        ("cycles_relative", "paper-time", "Length of the frame", "cycles, none = 1"),
        ("p_t_relative", "paper-sharing", "Sharing of node visits", "p_t, none = 1"),
        ("bytes_per_ray_relative", "paper-traffic", "DRAM traffic", "DRAM bytes a ray, none = 1"),
        ("energy_relative", "paper-energy", "Energy of the frame", "energy, none = 1"),
    ]
    plots = []
    for column, name, title, axis in shown:
        if machines[column].notna().any():
            text = "Against the machine without sorting and with the same memory. "
            text += "More is better." if column.startswith("p_t") else "Less is better."
            plots.append(Plot(name, title, text, _by_sorting(machines, column, axis)))
    if machines["ray_cache_kib"].notna().any():
        plots.insert(1, _by_size(machines))
    return plots


def all_figures(
    tables: dict[str, pd.DataFrame], gains: pd.DataFrame
) -> tuple[list[Plot], list[Plot], list[Plot]]:
    """The paper's figures; what explains differences; the hardware question."""
    return (
        [figure2(tables["table4"]), figure5(tables["table4"]), *figures_6_and_7(tables["table2"])],
        [gains_plot(gains), sway_plot(tables["sway"])],
        hardware_plots(tables["machines"]) if len(tables["machines"]) else [],
    )
