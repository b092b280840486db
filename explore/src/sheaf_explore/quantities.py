# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Values with units, read and written as the simulator does: "32KiB", "1.5GHz"; and durations."""

from __future__ import annotations

import re

BYTE_UNITS = {"": 1, "B": 1, "KiB": 2**10, "MiB": 2**20, "GiB": 2**30, "TiB": 2**40}
FREQUENCY_UNITS = {"": 1.0, "Hz": 1.0, "kHz": 1e3, "MHz": 1e6, "GHz": 1e9, "THz": 1e12}
DURATION_UNITS = {"": 1.0, "s": 1.0, "min": 60.0, "h": 3600.0}

_QUANTITY = re.compile(r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?) ?([A-Za-z]*)", re.ASCII)
_WINDOW = re.compile(r"(\d{0,18})\.\.(\d{0,18})", re.ASCII)
_LAST = 10**18  # cycles


def _split(text: str, units: dict[str, float] | dict[str, int]) -> tuple[str, float] | None:
    match = _QUANTITY.fullmatch(text.strip())
    if match is None or match[2] not in units:
        return None
    return match[1], units[match[2]]


def parse_bytes(text: str) -> int | None:
    """A whole number of bytes, or None if the text is no such quantity."""
    parts = _split(text, BYTE_UNITS)
    return int(parts[0]) * int(parts[1]) if parts and parts[0].isdigit() else None


def parse_frequency(text: str) -> float | None:
    """Hertz, or None."""
    parts = _split(text, FREQUENCY_UNITS)
    return float(parts[0]) * parts[1] if parts else None


def parse_duration(text: str) -> float | None:
    """Seconds, or None: "90s", "10min", "1.5h"."""
    parts = _split(text, DURATION_UNITS)
    return float(parts[0]) * parts[1] if parts else None


def is_window(text: str) -> bool:
    """Whether the text is FIRST..END with FIRST < END; either may be left out."""
    match = _WINDOW.fullmatch(text)
    return match is not None and int(match[1] or 0) < int(match[2] or _LAST)


def format_bytes(count: int) -> str:
    """The shortest text that parse_bytes reads back exactly."""
    for unit in ("TiB", "GiB", "MiB", "KiB"):
        if count >= BYTE_UNITS[unit] and count % BYTE_UNITS[unit] == 0:
            return f"{count // BYTE_UNITS[unit]}{unit}"
    return f"{count}B"


def format_frequency(hertz: float) -> str:
    """Text that parse_frequency reads back exactly."""
    for unit in ("THz", "GHz", "MHz", "kHz"):
        text = f"{hertz / FREQUENCY_UNITS[unit]:g}{unit}"
        if hertz >= FREQUENCY_UNITS[unit] and parse_frequency(text) == hertz:
            return text
    return f"{hertz!r}Hz"


def format_duration(seconds: float) -> str:
    """For people: "48 s", "12 min", "3.4 h"."""
    if seconds < 10:
        return f"{seconds:.1f} s"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
