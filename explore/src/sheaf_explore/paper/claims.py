# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""What the paper says of its figures, each as a check of its figures and of ours."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pandas as pd

# "Slightly more" is at most a quarter above none; the paper's own are 1 to 11 %.
SLIGHTLY = 0.25


@dataclass(frozen=True)
class Case:
    """One place where a claim can be checked; None where there is no figure."""

    scene: str
    stands_for: str
    spot: str  # level, kind of rays or direction, where a scene has several cases
    ours: bool | None
    paper: bool | None
    evidence: str

    @property
    def place(self) -> str:
        return f"{self.scene}, {self.spot}" if self.spot else self.scene


@dataclass(frozen=True)
class Claim:
    """A claim with all its cases. It holds if it holds wherever it does in the paper's figures."""

    name: str
    text: str
    cases: tuple[Case, ...]

    @property
    def known(self) -> list[Case]:
        return [case for case in self.cases if case.ours is not None]

    @property
    def holds(self) -> bool | None:
        """None if nothing is known."""
        decisive = [case for case in self.known if case.paper is not False]
        return all(case.ours for case in decisive) if decisive else None

    @property
    def exceptions(self) -> list[Case]:
        return [case for case in self.known if case.ours is False]

    @property
    def count(self) -> int:
        return sum(case.ours is True for case in self.known)

    @property
    def count_paper(self) -> int:
        return sum(case.paper is True for case in self.cases)


Check = Callable[["pd.Series[float]"], bool]


def _case(group: pd.DataFrame, spot: str, index: str, check: Check) -> Case:
    """Applies a check to our figures and to the paper's, by the column `index`."""
    answers: dict[str, bool | None] = {}
    for column in ("ours", "paper"):
        values = group.set_index(index)[column].astype(float)
        known = not values.empty and not values.isna().any()
        answers[column] = check(values) if known else None
    ours = ", ".join(f"{k} {v:.3g}" for k, v in zip(group[index], group["ours"], strict=True))
    scene, stands_for = group["scene"].iloc[0], group["stands_for"].iloc[0]
    return Case(scene, stands_for, spot, answers["ours"], answers["paper"], ours)


def _by_level(table4: pd.DataFrame, check: Check) -> Iterator[Case]:
    chosen = table4[table4["measure"] == "p_t"]
    for (_, level), group in chosen.groupby(["scene", "level"], sort=False):
        yield _case(group, f"level {level}", "heuristic", check)


def _depth(table4: pd.DataFrame) -> Iterator[Case]:
    chosen = table4[(table4["measure"] == "c_t") & (table4["heuristic"] == "none")]
    for _, group in chosen.groupby("scene", sort=False):
        rises = group["stands_for"].iloc[0] == "fairy"

        def check(values: pd.Series[float], rises: bool = rises) -> bool:
            steps = values.diff().dropna()
            return bool((steps > 0).all() if rises else (steps < 0).all())

        yield _case(group, "rises" if rises else "falls", "level", check)


def _interval(table3: pd.DataFrame) -> Iterator[Case]:
    chosen = table3[(table3["measure"] == "p_t") & (table3["rays"] == "secondary")]
    for _, group in chosen.groupby("scene", sort=False):
        yield _case(group, "", "traversal", lambda p_t: bool(p_t["interval"] < 1))


def _omni(table3: pd.DataFrame) -> Iterator[Case]:
    def check(p_t: pd.Series[float]) -> bool:
        return bool(p_t["none"] < p_t["omni"] <= (1 + SLIGHTLY) * p_t["none"])

    chosen = table3[table3["measure"] == "p_t"]
    for (_, rays), group in chosen.groupby(["scene", "rays"], sort=False):
        yield _case(group, str(rays), "traversal", check)


def _sizes(table2: pd.DataFrame) -> Iterator[Case]:
    def check(p_t: pd.Series[float]) -> bool:
        share = p_t / p_t.index.to_numpy(dtype=float)
        return bool((p_t.diff().dropna() > 0).all() and (share.diff().dropna() < 0).all())

    for _, group in table2[table2["measure"] == "p_t"].groupby("scene", sort=False):
        yield _case(group, "", "packet_size", check)


def check_coherence(table4: pd.DataFrame) -> list[Claim]:
    """The claims that table 4 can decide."""
    return [
        Claim(
            "depth",
            "c_t falls with depth for four scenes and rises for fairy",
            tuple(_depth(table4)),
        ),
        Claim(
            "opos-leads",
            "opos leads p_t everywhere",
            tuple(_by_level(table4, lambda p_t: bool(p_t["opos"] >= p_t.max()))),
        ),
        Claim(
            "fastpos-weakest",
            "fastpos has the lowest p_t",
            tuple(_by_level(table4, lambda p_t: bool(p_t["fastpos"] <= p_t.min()))),
        ),
    ]


def check_claims(table2: pd.DataFrame, table3: pd.DataFrame, table4: pd.DataFrame) -> list[Claim]:
    """All claims of the paper that its tables can decide."""
    return [
        *check_coherence(table4),
        Claim(
            "interval-below-one",
            "interval's p_t of secondary rays falls below one",
            tuple(_interval(table3)),
        ),
        Claim(
            "omni-slightly-more",
            "omni gives slightly more than none: above it, by at most a quarter",
            tuple(_omni(table3)),
        ),
        Claim(
            "packet-size",
            "p_t grows with packet size while p_t / size falls",
            tuple(_sizes(table2)),
        ),
    ]


def frame_of(claims: list[Claim]) -> pd.DataFrame:
    """Claims as a table, a row a case."""
    return pd.DataFrame(
        {
            "claim": claim.name,
            "place": case.place,
            "holds": case.ours,
            "holds_in_paper": case.paper,
            "evidence": case.evidence,
        }
        for claim in claims
        for case in claim.cases
    )
