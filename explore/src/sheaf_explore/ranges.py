# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Ranges of values: "4KiB..4MiB x2", "1..16 +3", "1..8", "0.0..1.0", "1e3..1e9 log"."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameter, Value

MAX_LEVELS = 100_000

_RANGE = re.compile(r"\s*(.+?)\s*\.\.\s*(.+?)(?:\s+(?:x\s*(\S+)|\+\s*(.+?)|(log)))?\s*")


@dataclass(frozen=True)
class Continuum:
    """All numbers from low to high, uniformly or by their logarithm; only samples can use it."""

    low: float
    high: float
    logarithmic: bool

    def at(self, share: float) -> float:
        """The number at 0 <= share < 1 of the way."""
        if self.logarithmic:
            return math.exp(math.log(self.low) + share * math.log(self.high / self.low))
        return self.low + share * (self.high - self.low)


def _number(parameter: Parameter, text: str) -> int | float:
    if parameter.quantity:
        value = parameter.check(text)
    else:
        try:
            value = parameter.check(int(text) if re.fullmatch(r"[+-]?\d+", text) else float(text))
        except ValueError:
            raise ExploreError(f"{text!r} is no number") from None
    if isinstance(value, (str, bool, tuple)):
        raise ExploreError(f"{parameter.key} takes no range: its values are no numbers")
    return value


def _factor(text: str) -> float:
    try:
        factor = float(text)
    except ValueError:
        raise ExploreError(f"the factor x{text} is no number") from None
    if not factor > 1 or not math.isfinite(factor):
        raise ExploreError(f"the factor x{text} must be above 1")
    return factor


def _exact(value: float, parameter: Parameter) -> Value:
    whole = round(value)
    return parameter.check(whole if abs(value - whole) <= 1e-9 * max(1.0, abs(value)) else value)


def _geometric(parameter: Parameter, low: float, high: float, factor: float) -> list[Value]:
    if low <= 0:
        raise ExploreError("a range with a factor must begin above 0")
    count = math.floor(math.log(high / low) / math.log(factor) + 1e-9) + 1
    _limit(count)
    return [_exact(low * factor**i, parameter) for i in range(count)]


def _arithmetic(parameter: Parameter, low: float, high: float, step: float) -> list[Value]:
    if step <= 0:
        raise ExploreError("the step of a range must be above 0")
    count = math.floor((high - low) / step + 1e-9) + 1
    _limit(count)
    return [_exact(low + i * step, parameter) for i in range(count)]


def _limit(count: int) -> None:
    if count > MAX_LEVELS:
        raise ExploreError(f"the range has {count} values; the limit is {MAX_LEVELS}")


def parse_range(parameter: Parameter, text: str) -> list[Value] | Continuum:
    """The values of a range, both ends included where the steps meet them.

    Raises ExploreError without a place, which the caller adds.
    """
    match = _RANGE.fullmatch(text)
    if match is None:
        raise ExploreError(f"{text!r} is no range; write 4KiB..4MiB x2, 1..16 +3, 1..8 or 0..1 log")
    low, high = _number(parameter, match[1]), _number(parameter, match[2])
    if low > high:
        raise ExploreError(f"the range {text!r} ends before it begins")
    if match[3]:
        return _geometric(parameter, low, high, _factor(match[3]))
    if match[4]:
        step = parameter_step(parameter, match[4])
        return _arithmetic(parameter, low, high, step)
    if match[5] and low <= 0:
        raise ExploreError("a logarithmic range must begin above 0")
    if match[5] or isinstance(low, float) or isinstance(high, float):
        return Continuum(low, high, bool(match[5]))
    return _arithmetic(parameter, low, high, 1)


def parameter_step(parameter: Parameter, text: str) -> float:
    """The step of an arithmetic range; it has the parameter's unit but not its limits."""
    unlimited = Parameter(parameter.key, {"type": "number"}, parameter.quantity)
    return float(_number(unlimited, text))
