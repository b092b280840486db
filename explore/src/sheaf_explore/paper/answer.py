# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The answer to the hardware question in plain words, said by the figures."""

from __future__ import annotations

import math

import pandas as pd

from sheaf_explore.paper.hardware import PAYS, Verdict

LIMITS = (
    "Three scenes, one frame each, one point light, mirrors without roughness, recursion level 2. "
    "Rays scattered by rough surfaces or many lights would be less coherent and leave more to gain.",
    "One size of machine: two traversal and two intersection units of eight lanes. Units that are "
    "wide compared with the memory gain less from fewer steps; narrow ones gain more.",
    "The ray cache is modelled kindly: it has no port conflicts, its sweeps take a cycle, and pos "
    "compares with all anchors at once. Real ones would cost more than is counted here.",
    "Credits are the same for all machines. A machine tuned for each sorting would move single "
    "figures by some percent.",
    "KiB counts the data of caches, ray cache and packet FIFO, not tags, nor the store for rays in "
    "flight, which sorting makes no smaller.",
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
    sentences = [
        f"Sorting shortens the frame by more than {PAYS:.0%} in {len(pays)} of {len(found)} pairs "
        f"of scene and memory{': ' + listed if listed else ''}.",
        f"The best case is {best.scene} with {best.memory}: {best.best} makes the frame "
        f"{_change(best.time, 'shorter', 'longer')} and its DRAM traffic a ray "
        f"{_change(best.traffic, 'smaller', 'larger')}.",
    ]
    return [*sentences, *_by_heuristic(machines), *_why(machines), *_energy(machines)]


def _sorted(machines: pd.DataFrame) -> pd.DataFrame:
    return machines[machines["heuristic"] != "none"].dropna(subset=["cycles_relative"])


def _by_heuristic(machines: pd.DataFrame) -> list[str]:
    means = _sorted(machines).groupby("sorting", sort=False)["cycles_relative"].mean()
    order = means.sort_values()
    listed = ", ".join(f"{name} {value:.2f}" for name, value in order.items())
    return [
        f"Mean length of the frame by sorting, none = 1, over all scenes and memories: {listed}."
    ]


def _why(machines: pd.DataFrame) -> list[str]:
    sorted_ = _sorted(machines)
    sharing = float(sorted_["p_t_relative"].mean())
    traffic = float(sorted_["bytes_per_ray_relative"].mean())
    sentence = (
        f"Over all sorted machines p_t is {_change(sharing, 'lower', 'higher')} than without "
        f"sorting, and DRAM traffic a ray {_change(traffic, 'lower', 'higher')}"
    )
    if traffic > 1:
        sentence += (
            ": rays that were spawned together touch the same nodes soon after one another, and "
            "sorting parts them, so that caches lose what packets gain"
        )
    return [sentence + "."]


def _energy(machines: pd.DataFrame) -> list[str]:
    known = _sorted(machines).dropna(subset=["energy_relative"])
    if known.empty:
        return []
    means = known.groupby("sorting", sort=False)["energy_relative"].mean().sort_values()
    listed = ", ".join(f"{name} {value:.2f}" for name, value in means.items())
    return [f"Mean energy of the frame, none = 1: {listed}."]
