# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The report of a sweep: one HTML page that needs no network, and each plot as PNG and SVG."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Any

import jinja2
import vl_convert

from sheaf_explore.charts import all_plots, explorer, labelled, measures_of, Plot
from sheaf_explore.collect import collect, Table
from sheaf_explore.store import Store, write_whole

_PNG_SCALE = 2.0
_SNIPPET = "window.vegaEmbed = vegaEmbed;"
_MAX_ROWS = 5000  # of the table of points; the page stays quick, and all are in results.csv


def spec_of(plot: Plot) -> str:
    """The chart as JSON that can stand in a script element."""
    chart: dict[str, Any] = plot.chart.to_dict()
    return json.dumps(chart, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c")


def chart_script() -> str:
    """JavaScript that draws charts, for pages that have no network."""
    return vl_convert.javascript_bundle(_SNIPPET)


def write_svg(folder: Path, plots: list[Plot]) -> None:
    """Writes each plot as SVG."""
    for plot in plots:
        picture = vl_convert.vegalite_to_svg(plot.chart.to_dict())
        write_whole(folder / f"{plot.name}.svg", picture)


def write_pictures(folder: Path, plots: list[Plot]) -> None:
    """Writes each plot as PNG and SVG."""
    for plot in plots:
        png = vl_convert.vegalite_to_png(plot.chart.to_dict(), scale=_PNG_SCALE)
        write_whole(folder / f"{plot.name}.png", png)
    write_svg(folder, plots)


def _number(value: Any) -> str:
    if value != value:  # not a number: no such counter at this point
        return ""
    return f"{value:,.0f}" if float(value).is_integer() else f"{value:.4g}"


def _links(store: Store, point: str) -> list[tuple[str, str]]:
    """What a point's folder holds, by name and address relative to the report."""
    folder = store.folder / "points" / point
    files = {"image": "image.png", "timeline": "timeline.perfetto-trace"}
    links = [("folder", f"../points/{point}/")]
    return links + [
        (name, f"../points/{point}/{file}")
        for name, file in files.items()
        if (folder / file).exists()
    ]


def _rows(store: Store, table: Table, measures: list[str]) -> list[dict[str, Any]]:
    places = [labelled(table, axis) for axis in table.axes]
    scenes, modes = list(table.frame["scene"]), list(table.frame["mode"])
    values = [[_number(v) for v in table.frame[m].astype(float)] for m in measures]
    return [
        {
            "point": point,
            "scene": Path(scenes[i]).name,
            "mode": modes[i],
            "places": [column[i] for column in places],
            "numbers": [column[i] for column in values],
            "links": _links(store, point),
        }
        for i, point in enumerate(table.frame["point"][:_MAX_ROWS])
    ]


def _page(store: Store, table: Table, plots: list[Plot], notes: list[str]) -> str:
    template = resources.files("sheaf_explore").joinpath("report.html").read_text("utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    interactive = [explorer(table), *plots]
    measures = measures_of(table)
    modes = table.frame["mode"].value_counts().to_dict()
    rows = _rows(store, table, measures)
    return environment.from_string(template).render(
        table=table,
        plots=[(plot, spec_of(plot)) for plot in interactive],
        notes=notes,
        measures=measures,
        units=table.units,
        rows=rows,
        timelines=any(name == "timeline" for row in rows for name, _ in row["links"]),
        replayed=int(modes.get("replayed", 0)),
        live=int(modes.get("live", 0)),
        missing=table.total - len(table.frame) - len(table.failures),
        scenes=sorted({Path(scene).name for scene in table.frame["scene"]}),
        script=chart_script(),
    )


def write_report(store: Store) -> Path:
    """Collects the sweep and writes its report; returns the page. Raises ExploreError."""
    table = collect(store)
    table.write(store.folder)
    plots, notes = all_plots(table)
    folder = store.folder / "report"
    write_pictures(folder, plots)
    for old in [*folder.glob("*.png"), *folder.glob("*.svg")]:
        if old.stem not in {plot.name for plot in plots}:
            old.unlink()
    page = folder / "index.html"
    write_whole(page, _page(store, table, plots, notes))
    return page
