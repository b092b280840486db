# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The points of a sweep as a table for people."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.table import Table

from sheaf_explore.sweep import Sweep


def list_points(sweep: Sweep) -> None:
    """Prints every point to standard output: name, place on each axis, and whether it is done."""
    table = Table(title=f"{sweep.spec.name}: {len(sweep.points)} points", title_justify="left")
    table.add_column("point", no_wrap=True)
    table.add_column("scene")
    for axis in sweep.spec.axes:
        table.add_column(axis.name)
    table.add_column("state")
    parameters = sweep.simulator.parameters
    for entry in sweep.entries:
        labels = [
            parameters[name].text(label) if name in parameters else str(label)
            for name, label in entry.labels.items()
        ]
        refused = sweep.store.refusal(entry.id) is not None
        state = "done" if sweep.store.is_done(entry.id) else "refused" if refused else "to do"
        table.add_row(entry.id, entry.scene, *labels, state)
    console = Console(file=sys.stdout)
    if not console.is_terminal:
        console.width = 200
    console.print(table)
