# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Columns computed from a point's counters and its resolved configuration.

SRAM counts the data arrays of caches, ray cache and packet FIFO: no tags, no flip-flops, no packet
store. A ray has 343 bits, a packet n rays and a mask of n bits (rtl_notes/README.md, symbols R and
n; rtl_notes/ray_cache.md and packet_fifo.md, "State and SRAM").
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

RAY_BITS = 343
_NATURAL_CELLS = {"dir": 8, "fastpos": 8, "pos": 64}
_CACHES = {
    "node_cache": r"system\.traversal_unit\d+\.node_cache\.num_accesses",
    "triangle_cache": r"system\.intersection_unit\d+\.triangle_cache\.num_accesses",
    "attribute_cache": r"system\.shader_unit\d+\.attribute_cache\.num_accesses",
    "texture_cache": r"system\.shader_unit\d+\.texture_cache\.num_accesses",
    "film_cache": r"system\.film\.cache\.num_accesses",
    "l2": r"system\.l2\.num_accesses",
}

Counters = Mapping[str, Any]
Settings = Mapping[str, Any]


def _instances(counters: Counters, pattern: str) -> int:
    return sum(1 for name in counters if re.fullmatch(pattern, name))


def _cells(settings: Settings) -> int:
    if settings["ray_cache.cells"]:
        return int(settings["ray_cache.cells"])
    kind, _, argument = str(settings["ray_cache.heuristic"]).partition("(")
    if kind == "mdir":
        return int(float(argument.rstrip(") ")))
    return _NATURAL_CELLS.get(kind, 0)


def sram_bits(counters: Counters, settings: Settings) -> int | None:
    """Bits of SRAM of the machine that was built; None if none was, as without time."""
    if "system.cycles" not in counters:
        return None
    bits = 0
    for cache, pattern in _CACHES.items():
        if settings.get(f"{cache}.mode") == "normal":
            bits += _instances(counters, pattern) * 8 * int(settings[f"{cache}.capacity"])
    packet = int(settings["packet.size"])
    if "system.ray_cache.num_insertions" in counters:
        bits += _cells(settings) * packet * RAY_BITS
    if "system.packet_fifo.max_occupancy" in counters:
        bits += int(settings["packet_fifo.depth"]) * packet * (RAY_BITS + 1)
    return bits


def _sum(counters: Counters, pattern: str) -> float | None:
    values = [value for name, value in counters.items() if re.fullmatch(pattern, name)]
    return sum(values) if values else None


def derive(counters: Counters, settings: Settings) -> dict[str, tuple[Any, str]]:
    """Derived columns: value and unit."""
    derived: dict[str, tuple[Any, str]] = {}

    def add(name: str, value: Any, unit: str) -> None:
        if value is not None:
            derived[f"derived.{name}"] = (value, unit)

    add("sram_bits", sram_bits(counters, settings), "bits")
    add("dram_bytes", _sum(counters, r"system\.dram\.bytes_(read|written)"), "bytes")
    for cache, pattern in _CACHES.items():
        accesses = _sum(counters, pattern)
        hits = _sum(counters, pattern.replace("num_accesses", "num_hits"))
        if accesses and hits is not None:
            add(f"{cache}.hit_rate", hits / accesses, "1")
    return derived
