# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Columns computed from a point's counters: what sums over the units of a machine."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

_CACHES = {
    "node_cache": r"system\.traversal_unit\d+\.node_cache\.num_accesses",
    "triangle_cache": r"system\.intersection_unit\d+\.triangle_cache\.num_accesses",
    "attribute_cache": r"system\.shader_unit\d+\.attribute_cache\.num_accesses",
    "texture_cache": r"system\.shader_unit\d+\.texture_cache\.num_accesses",
    "film_cache": r"system\.film\.cache\.num_accesses",
    "l2": r"system\.l2\.num_accesses",
}

Counters = Mapping[str, Any]


def _sum(counters: Counters, pattern: str) -> float | None:
    values = [value for name, value in counters.items() if re.fullmatch(pattern, name)]
    return sum(values) if values else None


def derive(counters: Counters) -> dict[str, tuple[Any, str]]:
    """Derived columns: value and unit."""
    derived: dict[str, tuple[Any, str]] = {}

    def add(name: str, value: Any, unit: str) -> None:
        if value is not None:
            derived[f"derived.{name}"] = (value, unit)

    add("sram_bits", counters.get("area.sram_bits"), "bits")
    add("dram_bytes", _sum(counters, r"system\.dram\.bytes_(read|written)"), "bytes")
    for cache, pattern in _CACHES.items():
        accesses = _sum(counters, pattern)
        hits = _sum(counters, pattern.replace("num_accesses", "num_hits"))
        if accesses and hits is not None:
            add(f"{cache}.hit_rate", hits / accesses, "1")
    return derived
