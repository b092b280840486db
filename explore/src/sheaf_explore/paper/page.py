# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The report of the paper's experiments: one HTML page, each plot as a file, and the CSV files."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import jinja2
import pandas as pd

from sheaf_explore.charts import Plot
from sheaf_explore.paper import answer, figures, grids, hardware, sway, tables
from sheaf_explore.paper import plan as design
from sheaf_explore.paper.claims import Case, check_claims, check_coherence, Claim, frame_of
from sheaf_explore.paper.explain import scene_or_model
from sheaf_explore.paper.hardware import Verdict
from sheaf_explore.paper.markdown import write_markdown
from sheaf_explore.paper.plan import Plan
from sheaf_explore.paper.runs import Results
from sheaf_explore.report import chart_script, spec_of, write_pictures
from sheaf_explore.store import write_whole


@dataclass(frozen=True)
class Findings:
    """All that the report says, as tables."""

    plan: Plan
    tables: dict[str, pd.DataFrame]  # by the name of their CSV file
    claims: list[Claim]
    elsewhere: list[Claim]  # those of table 4, checked on other views of the scenes
    verdicts: list[Verdict]
    runs: int
    failed: int
    processor_seconds: float  # that the runs took

    @property
    def stand_in_ranks(self) -> pd.DataFrame:
        """Rank correlations of the stand-ins, without the real models."""
        ranks = self.tables["ranks"]
        return ranks[ranks["scene"] == ranks["stands_for"]]

    @property
    def median(self) -> float:
        """Median rank correlation of p_t over all stand-ins and levels."""
        return float(self.stand_in_ranks["spearman"].median())


def find(plan: Plan, results: Results, runs: int, failed: int, seconds: float) -> Findings:
    """Makes the tables of the report from the runs."""
    made = {
        "table1": tables.frame_rates(plan, results),
        "table2": tables.packet_sizes(plan, results),
        "table3": tables.traversals(plan, results),
        "table4": tables.coherence(plan, results),
        "sway": sway.sway(plan, results),
        "anchors": sway.anchors(plan, results),
        "machines": hardware.machines(plan, results),
    }
    views = plan.views()
    made["views"] = tables.coherence(views, results)
    made["ranks"] = tables.rank_correlations(made["table4"])
    made["gains"] = tables.gains(made["table4"])
    claims = check_claims(made["table2"], made["table3"], made["table4"])
    elsewhere = check_coherence(made["views"])
    made["claims"] = frame_of(claims)
    machines = made["machines"]
    found = hardware.verdicts(machines) if len(machines) else []
    return Findings(plan, made, claims, elsewhere, found, runs, failed, seconds)


def table_grids(findings: Findings) -> list[tuple[str, str, grids.Grid]]:
    """The paper's tables: heading, explanation, table."""
    made = findings.tables
    return [
        (
            "Table 1: frame rate",
            "Simulated frames per second at the configured clock; the paper's were measured on a "
            "3 GHz Pentium 4, so that only the ratios to none can be compared.",
            grids.table1(made["table1"]),
        ),
        ("Table 2: packet sizes", "Level 1, no sorting.", grids.table2(made["table2"])),
        (
            "Table 3: traversal",
            "Level 1, no sorting. “none” is masked traversal, one pass for each octant of "
            "directions in a packet.",
            grids.table3(made["table3"]),
        ),
        (
            "Table 4: coherence of secondary rays",
            "c_t and c_i belong to scene and tree and are the same for all heuristics.",
            grids.table4(made["table4"]),
        ),
    ]


def _docs_grids(findings: Findings) -> list[tuple[str, str, grids.Grid]]:
    """The same for a page of the documentation, which has no room for all of table 4."""
    *others, (title, about, _) = table_grids(findings)
    short = grids.table4(findings.tables["table4"], ("c_t", "p_t"))
    return [*others, (title, about + " c_i and p_i are in the report.", short)]


def _seen_twice(findings: Findings) -> list[tuple[Claim, Case, Case]]:
    """Claims of table 4 that do not say the same of a stand-in seen from elsewhere."""
    committed = {
        (claim.name, case.scene, case.spot): case
        for claim in findings.claims
        for case in claim.cases
    }
    return [
        (claim, before, case)
        for claim in findings.elsewhere
        for case in claim.cases
        for before in [committed[claim.name, case.stands_for, case.spot]]
        if before.ours != case.ours
    ]


def _context(findings: Findings) -> dict[str, Any]:
    made = findings.tables
    machines = made["machines"]
    paper, explaining, hardware_plots = figures.all_figures(made, made["gains"])
    return {
        "plan": findings.plan,
        "scenes": [scene.name for scene in findings.plan.scenes],
        "runs": findings.runs,
        "failed": findings.failed,
        "csv": [f"{name}.csv" for name in made],
        "answer": answer.answer(machines, findings.verdicts),
        "limits": answer.LIMITS,
        "verdicts": findings.verdicts,
        "verdict_grid": grids.verdicts(findings.verdicts),
        "sram_grid": grids.sram(machines) if len(machines) else None,
        "hardware_level": design.HARDWARE_LEVEL,
        "credits": f"{design.CREDITS:,}",
        "hardware_plots": hardware_plots,
        "claims": findings.claims,
        "elsewhere": findings.elsewhere,
        "explained": scene_or_model(made["table4"], made["gains"]),
        "pairs": len(findings.stand_in_ranks),
        "median": findings.median,
        "rank_grid": grids.ranks(made["ranks"]),
        "grids": table_grids(findings),
        "figures": paper,
        "explaining": explaining,
        "sway_grid": grids.sway(sway.ranges(made["sway"])),
        "anchor_grid": grids.anchors(made["anchors"]),
        "spec_of": spec_of,
    }


def _plots_of(context: dict[str, Any]) -> list[Plot]:
    """Every plot of the page."""
    return [*context["figures"], *context["explaining"], *context["hardware_plots"]]


def write_docs(folder: Path, findings: Findings) -> Path:
    """Writes the page of the documentation; returns it."""
    context = _context(findings)
    more = {
        "docs_grids": _docs_grids(findings),
        "seen_twice": _seen_twice(findings),
        "processor_minutes": f"{findings.processor_seconds / 60:.0f}",
    }
    return write_markdown(folder, context | more, _plots_of(context))


def write_page(folder: Path, findings: Findings) -> Path:
    """Writes index.html, the plots and the CSV files; returns the page."""
    context = _context(findings)
    template = resources.files("sheaf_explore.paper").joinpath("page.html").read_text("utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    page = environment.from_string(template).render(**context, script=chart_script())
    write_pictures(folder, _plots_of(context))
    for name, frame in findings.tables.items():
        text = frame.to_csv(index=False, lineterminator="\n", quoting=csv.QUOTE_MINIMAL)
        write_whole(folder / f"{name}.csv", text)
    write_whole(folder / "index.html", page)
    return folder / "index.html"
