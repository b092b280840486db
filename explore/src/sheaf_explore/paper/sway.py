# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""How far the measures move with what the paper does not print."""

from __future__ import annotations

import pandas as pd

from sheaf_explore.paper import plan as design
from sheaf_explore.paper.plan import Plan
from sheaf_explore.paper.runs import Results
from sheaf_explore.paper.tables import COUNTERS


def sway(plan: Plan, results: Results) -> pd.DataFrame:
    """p_t by heuristic, and c_t, under each variant; `change` is against the design's choice."""
    rows = []
    for scene in plan.varied_scenes():
        level = design.SWAY_LEVEL
        for variant in design.VARIANTS:
            for heuristic in variant.only:
                run = plan.coherence(scene, level, heuristic, variant)
                base = plan.coherence(scene, level, heuristic)
                row: dict[str, object] = {
                    "scene": scene.name,
                    "group": variant.group,
                    "variant": variant.name,
                    "heuristic": heuristic,
                }
                measures = ["p_t"] if heuristic != "none" else ["p_t", "c_t"]
                for measure in measures:
                    value = results.get(run, COUNTERS[measure])
                    before = results.get(base, COUNTERS[measure])
                    rows.append(
                        row | {"measure": measure, "ours": value, "change": value / before - 1}
                    )
    return pd.DataFrame(rows).dropna(subset=["ours"])


def anchors(plan: Plan, results: Results) -> pd.DataFrame:
    """p_t of pos(x) along x."""
    rows = [
        {"scene": scene.name, "x": float(name[4:-1]), "heuristic": name, "ours": p_t}
        for scene in plan.varied_scenes()
        for name in (*design.POS_HEURISTICS, "pos(1.0)")
        for p_t in [results.get(plan.coherence(scene, design.SWAY_LEVEL, name), COUNTERS["p_t"])]
    ]
    return pd.DataFrame(rows).sort_values(["scene", "x"], ignore_index=True)


def ranges(table: pd.DataFrame) -> pd.DataFrame:
    """For each group and variant the mean and the extreme changes over scenes and heuristics."""
    grouped = table[table["group"] != design.BASE.group].groupby(
        ["group", "variant", "measure"], sort=False
    )["change"]
    return grouped.agg(["mean", "min", "max"]).reset_index()
