# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that drop points: "ray_cache.cells * packet.size > 4096".

The grammar is Python's, cut down to numbers, texts, lists, arithmetic, comparisons, `and`, `or`,
`not`, `min`, `max` and `abs`; a dotted name is the value of that parameter at the point.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any

from sheaf_explore.errors import ExploreError
from sheaf_explore.quantities import parse_bytes, parse_frequency

MAX_LENGTH = 1000

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda a, b: a in b,
    ast.NotIn: lambda a, b: a not in b,
}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.Not: operator.not_,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_CALLS: dict[str, Callable[..., Any]] = {"min": min, "max": max, "abs": abs}


class Condition:
    """A condition, checked when made and then asked for each point."""

    def __init__(self, text: str) -> None:
        """Raises ExploreError without a place if the text is no condition."""
        self.text = text
        if len(text) > MAX_LENGTH:
            raise ExploreError(f"the condition is longer than {MAX_LENGTH} characters")
        try:
            self._tree = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise ExploreError(f"{text!r} is no condition; write a comparison of keys") from None
        self.names: set[str] = set()
        self._check(self._tree)

    def holds(self, values: Mapping[str, Any]) -> bool:
        """Whether the condition is true where parameters have these values."""
        try:
            return bool(self._evaluate(self._tree, values))
        except (TypeError, ZeroDivisionError, OverflowError, ValueError) as error:
            raise ExploreError(f"{self.text!r} cannot be computed: {error}") from None

    def _check(self, node: ast.expr) -> None:
        name = _dotted(node)
        if name is not None:
            self.names.add(name)
            return
        for part in _parts(node, self.text):
            self._check(part)

    def _evaluate(self, node: ast.expr, values: Mapping[str, Any]) -> Any:
        name = _dotted(node)
        if name is not None:
            return values[name]
        match node:
            case ast.Constant(value=value):
                return _quantity(value)
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                return [self._evaluate(part, values) for part in parts]
            case ast.BoolOp(op=ast.And(), values=parts):
                return all(self._evaluate(part, values) for part in parts)
            case ast.BoolOp(values=parts):
                return any(self._evaluate(part, values) for part in parts)
            case ast.UnaryOp(op=op, operand=part):
                return _UNARY[type(op)](self._evaluate(part, values))
            case ast.BinOp(left=left, op=op, right=right):
                return _BINARY[type(op)](
                    _number(self._evaluate(left, values)), _number(self._evaluate(right, values))
                )
            case ast.Compare(left=left, ops=ops, comparators=rights):
                sides = [self._evaluate(part, values) for part in (left, *rights)]
                return all(_COMPARE[type(op)](sides[i], sides[i + 1]) for i, op in enumerate(ops))
            case ast.Call(func=ast.Name(id=function), args=parts):
                return _CALLS[function](*(self._evaluate(part, values) for part in parts))
        raise AssertionError("checked when the condition was made")


def _dotted(node: ast.expr) -> str | None:
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        prefix = _dotted(node.value)
        return None if prefix is None else f"{prefix}.{node.attr}"
    return None


def _number(value: Any) -> Any:
    if not isinstance(value, (int, float)):
        raise TypeError(f"{value!r} is no number")
    return value


def _quantity(value: Any) -> Any:
    """Texts such as '64KiB' and '1GHz' mean the number."""
    if not isinstance(value, str) or not value[:1].isdigit():
        return value
    for parse in (parse_bytes, parse_frequency):
        number = parse(value)
        if number is not None:
            return number
    return value


def _parts(node: ast.expr, text: str) -> list[ast.expr]:
    match node:
        case ast.Constant(value=bool() | int() | float() | str()):
            return []
        case ast.List(elts=parts) | ast.Tuple(elts=parts) | ast.BoolOp(values=parts):
            return parts
        case ast.UnaryOp(op=op, operand=part) if type(op) in _UNARY:
            return [part]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            return [left, right]
        case ast.Compare(left=left, ops=ops, comparators=rights) if all(
            type(op) in _COMPARE for op in ops
        ):
            return [left, *rights]
        case ast.Call(func=ast.Name(id=name), args=parts, keywords=[]) if name in _CALLS and parts:
            return parts
    raise ExploreError(
        f"{text!r}: {ast.unparse(node)!r} is not allowed in a condition; allowed are keys, values, "
        "+ - * / // %, comparisons, in, and, or, not, min, max, abs"
    )
