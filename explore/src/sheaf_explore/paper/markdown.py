# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The report as a page of the documentation: Markdown, with its plots as SVG beside it."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Any

import jinja2

from sheaf_explore.charts import Plot
from sheaf_explore.paper.grids import Cell, Grid
from sheaf_explore.report import write_svg
from sheaf_explore.store import write_whole

_IMAGES = "images"


def _cell(cell: Cell) -> str:
    """Our figure, and the paper's in brackets."""
    return f"{cell.ours} ({cell.paper})" if cell.paper else cell.ours


def _line(parts: list[str]) -> str:
    return "| " + " | ".join(parts) + " |"


def table(grid: Grid) -> str:
    """A grid as a Markdown table; the name of a group stands before its columns' names."""
    groups = [name for name, span in grid.groups for _ in range(span)]
    heads = list(grid.columns[: grid.labels])
    for i, name in enumerate(grid.columns[grid.labels :]):
        heads.append(f"{groups[i]}: {name}" if groups else name)
    rule = ["---"] * grid.labels + ["---:"] * (len(grid.columns) - grid.labels)
    rows = [_line([*row.labels, *map(_cell, row.cells)]) for row in grid.rows]
    return "\n".join([_line(heads), _line(rule), *rows])


def _verdict(holds: bool | None) -> str:
    return "no figure" if holds is None else "holds" if holds else "does not hold"


def write_markdown(folder: Path, context: dict[str, Any], plots: list[Plot]) -> Path:
    """Writes paper.md and images/paper-*.svg into a folder of documents; returns the page."""
    template = resources.files("sheaf_explore.paper").joinpath("page.md.jinja").read_text("utf-8")
    environment = jinja2.Environment(
        autoescape=False, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    text = environment.from_string(template).render(
        **context,
        table=table,
        verdict=_verdict,
        image=lambda plot: f"![{plot.title}]({_IMAGES}/{plot.name}.svg)",
    )
    write_svg(folder / _IMAGES, plots)
    write_whole(folder / "paper.md", text.rstrip() + "\n")
    return folder / "paper.md"
