# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's tables with our figure beside each of its own."""

from __future__ import annotations

import pandas as pd

from sheaf_explore.paper import plan as design
from sheaf_explore.paper import published
from sheaf_explore.paper.plan import Plan
from sheaf_explore.paper.ranks import kendall, spearman
from sheaf_explore.paper.runs import Results, Run, Scene

# Where a measure of secondary rays stands in a run's counters.
COUNTERS = {
    "c_t": "coherence.secondary.c_t",
    "p_t": "trace.secondary.p_t",
    "c_i": "coherence.secondary.c_i",
    "p_i": "trace.secondary.p_i",
}
_OF_SCENE = ("c_t", "c_i")  # measures that no heuristic changes
PRINTED_DECIMALS = 1  # of the paper's c and p


def beside(ours: pd.DataFrame, paper: pd.DataFrame) -> pd.DataFrame:
    """Our rows with the paper's value, where it prints one, and the relative difference."""
    keys = [column for column in paper.columns if column != "paper"]
    theirs = paper.rename(columns={"scene": "stands_for"})
    on = ["stands_for" if key == "scene" else key for key in keys]
    table = ours.merge(theirs, on=on, how="left", validate="many_to_one")
    return table.assign(difference=table["ours"] / table["paper"] - 1)


def _scene(scene: Scene) -> dict[str, object]:
    return {"scene": scene.name, "stands_for": scene.stands_for}


def frame_rates(plan: Plan, results: Results) -> pd.DataFrame:
    """Table 1: frames per second; also relative to `none`, for the clocks differ by an age."""
    rows = [
        _scene(scene)
        | {"level": 1, "packet_size": 16, "heuristic": heuristic}
        | {"ours": results.get(run, "system.frames_per_second")}
        | {"cycles": results.get(run, "system.cycles")}
        for scene in plan.scenes
        for heuristic in design.TABLE1_HEURISTICS
        for run in [plan.frame_rate(scene, heuristic)]
    ]
    table = beside(pd.DataFrame(rows), published.frame_rates())
    base = table[table["heuristic"] == "none"].set_index("scene")
    for column in ("ours", "paper"):
        table[f"{column}_relative"] = table[column] / table["scene"].map(base[column])
    return table.assign(difference=table["ours_relative"] / table["paper_relative"] - 1)


def packet_sizes(plan: Plan, results: Results) -> pd.DataFrame:
    """Table 2: c_t and p_t along the size of packets, without sorting."""
    rows = []
    for scene in plan.scenes:
        for size in design.PACKET_SIZES:
            key = {"heuristic": "none", "level": 1, "packet_size": size}
            c_t = results.get(plan.coherence(scene, 1, "none"), COUNTERS["c_t"])
            p_t = results.get(plan.packet(scene, size), COUNTERS["p_t"])
            rows += [
                _scene(scene) | key | {"measure": measure, "ours": value}
                for measure, value in (("c_t", c_t), ("p_t", p_t))
            ]
    return beside(pd.DataFrame(rows), published.packet_sizes())


def traversals(plan: Plan, results: Results) -> pd.DataFrame:
    """Table 3: primary and secondary rays by masked, interval and omnidirectional traversal."""
    rows = []
    for scene in plan.traversal_scenes():
        for name, scheme in design.TRAVERSALS.items():
            run, base = plan.traversal(scene, scheme), plan.coherence(scene, 1, "none")
            for rays in ("primary", "secondary"):
                key = {"traversal": name, "rays": rays, "level": 1, "packet_size": 16}
                values = {
                    "c_t": results.get(base, f"coherence.{rays}.c_t"),
                    "p_t": results.get(run, f"trace.{rays}.p_t"),
                }
                rows += [_scene(scene) | key | {"measure": m, "ours": v} for m, v in values.items()]
    columns = ["scene", "stands_for", "traversal", "rays", "level", "packet_size"]
    ours = pd.DataFrame(rows, columns=[*columns, "measure", "ours"])
    return beside(ours, published.traversals())


def coherence(plan: Plan, results: Results) -> pd.DataFrame:
    """Table 4: all four measures of secondary rays, by heuristic and level."""
    rows = []
    for scene in plan.scenes:
        for level in design.LEVELS:
            for heuristic in design.HEURISTICS:
                for measure in COUNTERS:
                    run = coherence_run(plan, scene, level, heuristic, measure)
                    key = {"level": level, "heuristic": heuristic, "measure": measure}
                    rows.append(_scene(scene) | key | {"ours": results.get(run, COUNTERS[measure])})
    return beside(pd.DataFrame(rows), published.coherence())


def coherence_run(plan: Plan, scene: Scene, level: int, heuristic: str, measure: str) -> Run:
    """The run that a measure is read from."""
    return plan.coherence(scene, level, "none" if measure in _OF_SCENE else heuristic)


def rank_correlations(table4: pd.DataFrame, measure: str = "p_t") -> pd.DataFrame:
    """For each scene and level how far the paper's order of heuristics is ours.

    Both are compared as the paper prints, to one decimal, so that what is a tie in print is one
    here. `ours` and `paper` also hold the spread, the best over the worst heuristic.
    """
    rows = []
    chosen = table4[table4["measure"] == measure]
    for (scene, level), group in chosen.groupby(["scene", "level"], sort=False):
        ours, paper = group["ours"].round(PRINTED_DECIMALS), group["paper"]
        known = not (ours.isna().any() or paper.isna().any())
        rows.append(
            {
                "scene": scene,
                "stands_for": group["stands_for"].iloc[0],
                "level": level,
                "spearman": spearman(ours, paper) if known else float("nan"),
                "kendall": kendall(ours, paper) if known else float("nan"),
                "spread_ours": group["ours"].max() / group["ours"].min(),
                "spread_paper": paper.max() / paper.min(),
            }
        )
    return pd.DataFrame(rows)


def gains(table4: pd.DataFrame) -> pd.DataFrame:
    """p_t of each heuristic over that of `none`: what sorting does, with the scene divided out."""
    chosen = table4[table4["measure"] == "p_t"]
    base = chosen[chosen["heuristic"] == "none"].set_index(["scene", "level"])
    keys = pd.MultiIndex.from_frame(chosen[["scene", "level"]])
    table = chosen[["scene", "stands_for", "level", "heuristic"]].copy()
    for column in ("ours", "paper"):
        table[column] = chosen[column].to_numpy() / base[column].reindex(keys).to_numpy()
    return table.assign(difference=table["ours"] / table["paper"] - 1)
