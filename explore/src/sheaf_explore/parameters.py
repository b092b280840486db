# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator's parameters, as `sheaf config --schema` declares them."""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass
from typing import Any

from jsonschema import Draft202012Validator

from sheaf_explore.errors import ExploreError
from sheaf_explore.quantities import (
    format_bytes,
    format_frequency,
    parse_bytes,
    parse_frequency,
)

Value = bool | int | float | str | tuple[float, ...]


@dataclass(frozen=True)
class Parameter:
    """One parameter; `quantity` is "bytes", "frequency", or empty for a plain value."""

    key: str
    schema: dict[str, Any]
    quantity: str

    @property
    def meaning(self) -> str:
        return str(self.schema.get("description", ""))

    @property
    def free_text(self) -> bool:
        """Only the simulator can tell whether a value of this parameter makes sense."""
        return self.schema.get("type") == "string"

    def check(self, raw: object) -> Value:
        """The value in the one form in which it is compared and hashed: bytes and hertz as numbers.

        Raises ExploreError without a place, which the caller adds.
        """
        number = self._number(raw)
        plain = raw if number is None else number
        problems = sorted(Draft202012Validator(self.schema).iter_errors(plain), key=str)
        if problems or (isinstance(plain, float) and not math.isfinite(plain)):
            raise ExploreError(f"{self.key} = {raw!r} is refused: {self._expected()}")
        if isinstance(plain, list):
            return tuple(float(x) for x in plain)
        if isinstance(plain, float) and plain.is_integer() and self._takes_integers():
            return int(plain)
        assert isinstance(plain, (bool, int, float, str))
        return plain

    def text(self, value: Value) -> str:
        """The value as `--set` takes it and people read it."""
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, tuple):
            return "[" + ", ".join(repr(x) for x in value) + "]"
        if self.quantity == "bytes" and isinstance(value, int):
            return format_bytes(value)
        if self.quantity == "frequency" and isinstance(value, (int, float)):
            return format_frequency(value)
        return str(value)

    def _number(self, raw: object) -> float | int | None:
        if not isinstance(raw, str) or not self.quantity:
            return None
        return parse_bytes(raw) if self.quantity == "bytes" else parse_frequency(raw)

    def _takes_integers(self) -> bool:
        branches = self.schema.get("anyOf", [self.schema])
        return any(branch.get("type") == "integer" for branch in branches)

    def _expected(self) -> str:
        branches = self.schema.get("anyOf", [self.schema])
        return "expected " + " or ".join(_describe(branch) for branch in branches)


def _describe(branch: dict[str, Any]) -> str:
    if "enum" in branch:
        return "one of " + ", ".join(map(str, branch["enum"]))
    if "const" in branch:
        return repr(branch["const"])
    if "pattern" in branch:
        return "a quantity such as " + ("64KiB" if "iB" in branch["pattern"] else "1.5GHz")
    kind = {"integer": "a whole number", "number": "a number", "boolean": "true or false"}.get(
        str(branch.get("type")), f"a {branch.get('type')}"
    )
    if branch.get("type") == "array":
        return "three numbers"
    if "minimum" in branch:
        return f"{kind} from {branch['minimum']} to {branch['maximum']}"
    return kind


def _quantity_of(schema: dict[str, Any]) -> str:
    for branch in schema.get("anyOf", []):
        if "iB" in branch.get("pattern", ""):
            return "bytes"
        if "Hz" in branch.get("pattern", ""):
            return "frequency"
    return ""


class Parameters:
    """All parameters by dotted key."""

    def __init__(self, schema: dict[str, Any]) -> None:
        self._all: dict[str, Parameter] = {}
        self._declare("", schema)
        self.defaults: dict[str, Value] = {
            key: parameter.check(parameter.schema["default"])
            for key, parameter in self._all.items()
            if "default" in parameter.schema
        }

    def _declare(self, prefix: str, schema: dict[str, Any]) -> None:
        for name, part in schema.get("properties", {}).items():
            key = f"{prefix}{name}"
            if part.get("type") == "object":
                self._declare(f"{key}.", part)
            else:
                self._all[key] = Parameter(key, part, _quantity_of(part))

    def __contains__(self, key: str) -> bool:
        return key in self._all

    def __getitem__(self, key: str) -> Parameter:
        """Raises ExploreError naming the nearest key if there is no such parameter."""
        if key in self._all:
            return self._all[key]
        near = difflib.get_close_matches(key, self._all, 1)
        hint = f"; did you mean {near[0]!r}?" if near else "; `sheaf config` lists them all"
        raise ExploreError(f"unknown key {key!r}{hint}")
