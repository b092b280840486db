# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The figures that the paper prints, as tables of one value a row."""

from __future__ import annotations

from importlib import resources

import pandas as pd

KEYS = ["scene", "level", "heuristic", "measure"]


def _read(name: str) -> pd.DataFrame:
    path = resources.files("sheaf_explore.paper").joinpath("published", name)
    with path.open("r", encoding="utf-8") as stream:
        return pd.read_csv(stream).rename(columns={"recursion_level": "level"})


def frame_rates() -> pd.DataFrame:
    """Table 1: scene, level, packet_size, heuristic, paper (frames a second)."""
    return _read("table1_frame_rate.csv").rename(columns={"frames_per_second": "paper"})


def packet_sizes() -> pd.DataFrame:
    """Table 2: scene, heuristic, level, packet_size, measure, paper."""
    return _long(_read("table2_packet_size.csv"), ["c_t", "p_t"])


def traversals() -> pd.DataFrame:
    """Table 3: scene, traversal, rays, level, packet_size, measure, paper."""
    return _long(_read("table3_traversal.csv"), ["c_t", "p_t"])


def coherence() -> pd.DataFrame:
    """Table 4: scene, heuristic, level, measure, paper."""
    return _long(_read("table4_coherence.csv"), ["c_t", "p_t", "c_i", "p_i"])


def _long(frame: pd.DataFrame, measures: list[str]) -> pd.DataFrame:
    keys = [column for column in frame.columns if column not in measures]
    return frame.melt(keys, measures, var_name="measure", value_name="paper")
