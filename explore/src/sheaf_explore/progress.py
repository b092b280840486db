# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Progress of a sweep: a live line on a terminal, else a line now and then."""

from __future__ import annotations

import time
from types import TracebackType

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from sheaf_explore.quantities import format_duration
from sheaf_explore.task import Outcome

_QUIET_SECONDS = 10.0


class ProgressWatcher:
    """Shows how far a sweep is, when it will end, and failures as they happen."""

    def __init__(self, total: int, names: dict[str, str]) -> None:
        self._console = Console(stderr=True, highlight=False)
        self._total = total
        self._names = names
        self._done = 0
        self._failed = 0
        self._threads = 0
        self._started = time.monotonic()
        self._said = self._started
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TextColumn("{task.fields[note]}"),
            console=self._console,
            disable=not self._console.is_terminal,
        )
        self._task = self._bar.add_task("points", total=total, note="")

    def __enter__(self) -> ProgressWatcher:
        self._bar.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._bar.stop()

    def workers(self, threads: int) -> None:
        self._threads = threads
        self._show()

    def retrying(self, outcome: Outcome, attempt: int) -> None:
        self._say(f"attempt {attempt} of {self._name(outcome)}: {outcome.message}; trying again")

    def finished(self, outcome: Outcome) -> None:
        self._done += 1
        if outcome.kind not in ("done", "cancelled"):
            self._failed += 1
            self._say(f"failed: {self._name(outcome)}: {outcome.message}")
        self._show()

    def _name(self, outcome: Outcome) -> str:
        return f"{outcome.id} ({self._names.get(outcome.id, '')})"

    def _say(self, text: str) -> None:
        self._console.print(escape(text), soft_wrap=True)

    def _show(self) -> None:
        elapsed = time.monotonic() - self._started
        left = elapsed / self._done * (self._total - self._done) if self._done else None
        note = f"{format_duration(left)} left" if left is not None else "waiting for workers"
        note += f", {self._threads} at a time"
        if self._failed:
            note += f", {self._failed} failed"
        if not self._bar.disable:
            self._bar.update(self._task, completed=self._done, note=note)
        elif time.monotonic() - self._said > _QUIET_SECONDS:
            self._said = time.monotonic()
            self._say(f"{self._done} of {self._total} points, {note}")
