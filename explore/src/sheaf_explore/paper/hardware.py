# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The question the paper leaves open: with a machine's own numbers, does sorting pay?"""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from sheaf_explore.paper.plan import Plan
from sheaf_explore.paper.runs import Results

COSTS = {  # column: counter
    "cycles": "system.cycles",
    "p_t": "trace.secondary.p_t",
    "bytes_per_ray": "system.dram.bytes_per_ray",
    "bus": "system.dram.bus_utilization",
    "node_hits": "derived.node_cache.hit_rate",
    "energy": "energy.known",  # pJ
    "area": "area.sram_mm2",
    "ray_cache_area": "area.ray_cache.mm2",
}
PAYS = 0.01  # a gain below this share of the frame is called none


@dataclass(frozen=True)
class Verdict:
    """The best sorting for one scene and memory, against none."""

    scene: str
    memory: str
    best: str
    time: float  # of the frame, relative to none
    energy: float  # relative to none; not a number where it is unknown
    traffic: float
    pays: bool


def machines(plan: Plan, results: Results) -> pd.DataFrame:
    """A row a machine and scene; `_relative` columns are against `none` with the same memory."""
    rows = []
    for scene in plan.hardware_scenes():
        for machine in plan.machines():
            run = plan.machine(scene, machine)
            row: dict[str, object] = {
                "scene": scene.name,
                "memory": machine.memory,
                "heuristic": machine.heuristic,
                "cells": machine.cells,
                "sorting": machine.label,
            }
            row |= {column: results.get(run, counter) for column, counter in COSTS.items()}
            row["ray_cache_kib"] = results.get(run, "area.ray_cache.bits") / 8 / 1024
            rows.append(row)
    frame = pd.DataFrame(rows)
    return _relative(frame) if len(frame) else frame


def _relative(frame: pd.DataFrame) -> pd.DataFrame:
    places = ["scene", "memory"]
    base = frame[frame["heuristic"] == "none"].set_index(places)
    at = pd.MultiIndex.from_frame(frame[places])
    for column in ("cycles", "p_t", "bytes_per_ray", "energy", "area"):
        frame[f"{column}_relative"] = frame[column] / base[column].reindex(at).to_numpy()
    return frame


def verdicts(frame: pd.DataFrame) -> list[Verdict]:
    """For each scene and memory the sorting that shortens the frame most."""
    found = []
    for (scene, memory), group in frame.groupby(["scene", "memory"], sort=False):
        sorted_ = group[group["heuristic"] != "none"].dropna(subset=["cycles_relative"])
        if sorted_.empty:
            continue
        best = sorted_.sort_values("cycles_relative", kind="stable").iloc[0]
        found.append(
            Verdict(
                str(scene),
                str(memory),
                str(best["sorting"]),
                float(best["cycles_relative"]),
                float(best["energy_relative"]),
                float(best["bytes_per_ray_relative"]),
                bool(best["cycles_relative"] < 1 - PAYS),
            )
        )
    return found
