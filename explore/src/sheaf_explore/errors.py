# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Exit statuses of the explore command, and the error that carries one."""

from __future__ import annotations

from enum import IntEnum


class Exit(IntEnum):
    """Exit statuses; `explore --help` prints this list."""

    OK = 0
    FAILED_POINTS = 1
    REFUSED = 2
    CLUSTER = 3
    OUTPUT = 4
    INTERRUPTED = 130


class ExploreError(Exception):
    """Something that the user can mend: one line with the place, what is wrong and the remedy."""

    def __init__(self, message: str, status: Exit = Exit.REFUSED) -> None:
        super().__init__(message)
        self.status = status
