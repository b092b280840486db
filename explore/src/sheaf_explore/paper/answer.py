# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The answer to the hardware question in plain words, said by the figures."""

from __future__ import annotations

import math

import pandas as pd

from sheaf_explore.paper.hardware import PAYS, Verdict

LIMITS = (
    "Few scenes, one frame each, one point light, mirrors without roughness, recursion level 2. "
    "Rays scattered by rough surfaces or many lights would cohere less and leave more to gain.",
    "One size of machine: two traversal and two intersection units of eight lanes. Units that are "
    "wide compared with the memory gain less from fewer steps; narrow ones gain more.",
    "The ray cache is modelled kindly: it has no port conflicts, its sweeps take a cycle, and pos "
    "compares with all anchors at once. Real ones would cost more than is counted here.",
    "Credits are the same for all machines. A machine tuned for each sorting would move single "
    "figures by some percent.",
    "mm² is of SRAM alone, at 45 nm, and energy is a floor: it leaves out what has no published "
    "coefficient, control, clock tree, links and leakage among them.",
)


def _percent(share: float) -> str:
    return f"{abs(share):.0%}" if abs(share) >= 0.095 else f"{abs(share):.1%}"


def _change(relative: float, less: str, more: str) -> str:
    if math.isnan(relative):
        return ""
    if abs(relative - 1) < 0.0005:
        return "the same"
    return f"{_percent(relative - 1)} {less if relative < 1 else more}"


def answer(machines: pd.DataFrame, found: list[Verdict]) -> list[str]:
    """Sentences, the most important first."""
    if not found:
        return []
    pays = [v for v in found if v.pays]
    listed = "; ".join(f"{v.scene} with {v.memory} ({v.best})" for v in pays)
    best = min(found, key=lambda v: v.time)
    traffic = _change(best.traffic, "smaller", "larger")
    sentences = [
        f"Sorting shortens the frame by more than {PAYS:.0%} in {len(pays)} of {len(found)} pairs "
        f"of scene and memory{': ' + listed if listed else ''}.",
        f"The best case is {best.scene} with {best.memory}: {best.best} makes the frame "
        f"{_change(best.time, 'shorter', 'longer')}"
        + ("." if math.isnan(best.traffic) else f" and its DRAM traffic a ray {traffic}."),
    ]
    by_memory, why = _by_memory(found), _why(machines, found)
    others = (_by_heuristic(machines), _by_size(machines), _energy(machines))
    return [*sentences, by_memory, why, *(sentence for sentence in others if sentence)]


def _sorted(machines: pd.DataFrame) -> pd.DataFrame:
    return machines[machines["heuristic"] != "none"].dropna(subset=["cycles_relative"])


def _listed(values: pd.Series) -> str:
    """Names with their numbers."""
    return ", ".join(f"{name} {value:.2f}" for name, value in values.items())


def _by_memory(found: list[Verdict]) -> str:
    frame = pd.DataFrame({"memory": v.memory, "time": v.time} for v in found)
    means = frame.groupby("memory", sort=False)["time"].mean()
    return f"Mean length of the frame with each scene's best sorting, none = 1: {_listed(means)}."


def _why(machines: pd.DataFrame, found: list[Verdict]) -> str:
    """What the best sorting for each scene and memory shares, and what it costs."""
    best = {(v.scene, v.memory, v.best) for v in found}
    keys = machines[["scene", "memory", "sorting"]].itertuples(index=False, name=None)
    chosen = machines[[key in best for key in keys]]
    sharing = float(chosen["p_t_relative"].mean())
    traffic = float(chosen["bytes_per_ray_relative"].mean())
    sentence = (
        f"With the best sorting p_t is {_change(sharing, 'lower', 'higher')} than without, and "
        f"DRAM traffic a ray {_change(traffic, 'lower', 'higher')}"
    )
    if traffic > 1:
        sentence += (
            ": rays that were spawned together touch the same nodes soon after one another, and "
            "sorting parts them, so that caches lose what packets gain"
        )
    return sentence + "."


def _by_heuristic(machines: pd.DataFrame) -> str:
    means = _sorted(machines).groupby("sorting", sort=False)["cycles_relative"].mean()
    return (
        "Mean length of the frame by sorting over all scenes and memories, none = 1: "
        f"{_listed(means.sort_values())}."
    )


def _by_size(machines: pd.DataFrame) -> str:
    """Heuristics that were given ray caches of several sizes."""
    means = _sorted(machines).groupby(["heuristic", "cells"])["cycles_relative"].mean()
    parts = []
    for heuristic, sizes in means.groupby(level="heuristic"):
        if len(sizes) > 1:
            cells = ", ".join(str(cells) for _, cells in sizes.index)
            values = ", ".join(f"{value:.2f}" for value in sizes)
            parts.append(f"{heuristic} with {cells} cells takes {values}")
    return f"The size of the ray cache matters: {'; '.join(parts)}." if parts else ""


def _energy(machines: pd.DataFrame) -> str:
    known = _sorted(machines).dropna(subset=["energy_relative"])
    means = known.groupby("sorting", sort=False)["energy_relative"].mean().sort_values()
    return f"Mean energy of the frame, none = 1: {_listed(means)}." if len(means) else ""
