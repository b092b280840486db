# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Which line of a TOML file a value stands in; the standard reader does not tell."""

from __future__ import annotations

import tomllib
from typing import Any

Path = tuple[str | int, ...]


def _holds(document: Any, path: Path) -> bool:
    for step in path:
        if isinstance(step, int):
            if not isinstance(document, list) or step >= len(document):
                return False
        elif not isinstance(document, dict) or step not in document:
            return False
        document = document[step]
    return True


def line_of(text: str, path: Path) -> int:
    """The line, from 1, where the statement begins that defines `path` in a valid TOML text.

    A path that is not there is looked for by its beginning. Statements are told apart by reading
    ever longer parts of the text: a part that ends inside a statement is not valid.
    """
    document = tomllib.loads(text)
    while path and not _holds(document, path):
        path = path[:-1]
    if not path:
        return 1
    lines = text.splitlines()
    first = 0  # of the statement being read
    for end in range(1, len(lines) + 1):
        try:
            part = tomllib.loads("\n".join(lines[:end]) + "\n")
        except tomllib.TOMLDecodeError:
            continue
        if _holds(part, path):
            while first + 1 < end and _is_blank(lines[first]):
                first += 1
            return first + 1
        first = end
    return len(lines)


def _is_blank(line: str) -> bool:
    return not line.strip() or line.lstrip().startswith("#")
