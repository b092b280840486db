# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Which differences from the paper the scene explains, and which are left to the model."""

from __future__ import annotations

import pandas as pd

from sheaf_explore.paper.ranks import spearman

_FEW = 4  # places, below which a correlation says nothing


def _off(differences: pd.Series) -> str:
    """A median distance, in words."""
    return f"{differences.abs().median():.0%}"


def _none(table4: pd.DataFrame, measure: str) -> pd.Series:
    """Differences of a measure without sorting, by scene and level."""
    chosen = table4[(table4["heuristic"] == "none") & (table4["measure"] == measure)]
    return chosen.set_index(["scene", "level"])["difference"].dropna()


def scene_or_model(table4: pd.DataFrame, gains: pd.DataFrame) -> list[str]:
    """Sentences. c_t and c_i know neither packets nor heuristics: they are scene, view and tree."""
    own = table4["scene"] == table4["stands_for"]
    stand_ins = table4[own]
    sorted_ = gains[gains["heuristic"] != "none"]
    p_t = stand_ins[stand_ins["measure"] == "p_t"]["difference"].dropna()
    gain = sorted_[sorted_["scene"] == sorted_["stands_for"]]["difference"].dropna()
    if p_t.empty or gain.empty:
        return []
    sentences = [
        f"On the stand-ins p_t is off by {_off(p_t)} in the median, but p_t over that of none, "
        f"which is what a heuristic does, by {_off(gain)}."
    ]
    c, p = _none(stand_ins, "c_t"), _none(stand_ins, "p_t")
    both = c.index.intersection(p.index)
    if len(both) >= _FEW:
        sentences.append(
            f"c_t is the work of no heuristic and no packet: where it is off, scene, view or tree "
            f"are. It is off by {_off(c)} in the median, and the order in which places are off in "
            f"c_t is that in p_t with a rank correlation of {spearman(c[both], p[both]):.2f}."
        )
    for scene, group in table4[~own].groupby("scene", sort=False):
        ours = sorted_[sorted_["scene"] == scene]["difference"].dropna()
        off = group[group["measure"] == "p_t"]["difference"].dropna()
        of_c = group[group["measure"] == "c_t"]["difference"].dropna()
        sentences.append(
            f"{str(scene).capitalize()}, the paper's own model in a view and a light of our own: "
            f"p_t is off by {_off(off)}, c_t by {_off(of_c)}, p_t over none's by {_off(ours)}."
        )
    return sentences
