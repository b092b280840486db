# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures, the checks of its claims, ranks, and the words of the answer."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest
from conftest import Explore

from sheaf_explore.errors import ExploreError
from sheaf_explore.paper import answer, explain, grids, hardware, published, tables
from sheaf_explore.paper.claims import check_claims, Claim
from sheaf_explore.paper.command import choose_scenes, parse_size
from sheaf_explore.paper.plan import HEURISTICS, LEVELS, Plan
from sheaf_explore.paper.ranks import kendall, spearman
from sheaf_explore.paper.runs import Scene

SCENES = ("dragon", "fairy", "newtree", "oldtree", "sponza")
PLAN = Plan(tuple(Scene(name, Path(f"{name}.glb"), name) for name in SCENES), 64, 48)


def as_ours(paper: pd.DataFrame) -> pd.DataFrame:
    """The paper's own figures as if we had found them."""
    table = paper.assign(stands_for=paper["scene"], ours=paper["paper"])
    return table.assign(difference=table["ours"] / table["paper"] - 1)


def claims_of(table2: pd.DataFrame, table3: pd.DataFrame, table4: pd.DataFrame) -> dict[str, Claim]:
    return {claim.name: claim for claim in check_claims(table2, table3, table4)}


@pytest.fixture
def printed() -> list[pd.DataFrame]:
    """Tables 2, 3 and 4 as the paper prints them, in both columns."""
    paper = (published.packet_sizes(), published.traversals(), published.coherence())
    return [as_ours(table) for table in paper]


def test_the_published_tables_are_whole() -> None:
    table4 = published.coherence()
    assert len(table4) == len(SCENES) * len(HEURISTICS) * len(LEVELS) * 4
    assert set(table4["heuristic"]) == set(HEURISTICS)
    assert set(table4["scene"]) == set(SCENES)
    assert not table4["paper"].isna().any()
    assert len(published.packet_sizes()) == len(SCENES) * 5 * 2
    assert len(published.traversals()) == 2 * 2 * 3 * 2
    assert len(published.frame_rates()) == 5
    where = {"scene": "sponza", "level": 2, "heuristic": "opos", "measure": "p_t"}
    row = table4[(table4[list(where)] == pd.Series(where)).all(axis=1)]
    assert list(row["paper"]) == [6.7]


def test_rank_correlations_are_one_for_one_order_and_minus_one_for_its_reverse() -> None:
    a = pd.Series([1.0, 5.0, 2.0, 9.0])
    for correlation in (spearman, kendall):
        assert correlation(a, a**3) == pytest.approx(1)
        assert correlation(a, -a) == pytest.approx(-1)
        assert math.isnan(correlation(a, a * 0))


def test_rank_correlations_share_the_rank_of_ties() -> None:
    # Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 * 5); 5 of 6 pairs agree, one is tied.
    a, b = pd.Series([1.0, 2.0, 2.0, 3.0]), pd.Series([1.0, 2.0, 3.0, 4.0])
    assert spearman(a, b) == pytest.approx(4.5 / math.sqrt(22.5))
    assert kendall(a, b) == pytest.approx(5 / math.sqrt(30))


def test_every_claim_holds_in_the_papers_own_figures(printed: list[pd.DataFrame]) -> None:
    claims = claims_of(*printed)
    assert len(claims) == 6
    for claim in claims.values():
        assert claim.holds, claim
    # Even the paper has pos below fastpos once: a claim is held to where it holds in print.
    assert claims["fastpos-weakest"].count_paper == 14


Place = dict[str, object]
FALSIFIED: list[tuple[str, int, Place, float]] = [
    ("depth", 2, {"scene": "fairy", "level": 3, "measure": "c_t"}, 40.0),
    ("depth", 2, {"scene": "sponza", "level": 2, "measure": "c_t"}, 37.0),
    ("opos-leads", 2, {"scene": "dragon", "level": 1, "heuristic": "dir", "measure": "p_t"}, 6.0),
    (
        "fastpos-weakest",
        2,
        {"scene": "oldtree", "level": 3, "heuristic": "pos(1.0)", "measure": "p_t"},
        1.7,
    ),
    (
        "interval-below-one",
        1,
        {"scene": "newtree", "traversal": "interval", "rays": "secondary", "measure": "p_t"},
        1.01,
    ),
    (
        "omni-slightly-more",
        1,
        {"scene": "newtree", "traversal": "omni", "rays": "primary", "measure": "p_t"},
        8.9,
    ),
    (
        "omni-slightly-more",
        1,
        {"scene": "newtree", "traversal": "omni", "rays": "primary", "measure": "p_t"},
        12.0,
    ),
    ("packet-size", 0, {"scene": "fairy", "packet_size": 64, "measure": "p_t"}, 11.0),
    ("packet-size", 0, {"scene": "fairy", "packet_size": 64, "measure": "p_t"}, 23.0),
]


@pytest.mark.parametrize(("name", "table", "where", "value"), FALSIFIED)
def test_one_wrong_figure_makes_its_claim_fail_and_is_named(
    printed: list[pd.DataFrame], name: str, table: int, where: Place, value: float
) -> None:
    frame = printed[table]
    chosen = (frame[list(where)] == pd.Series(where)).all(axis=1)
    assert chosen.any()
    printed[table] = frame.assign(ours=frame["ours"].mask(chosen, value))
    failed = [claim for claim in claims_of(*printed).values() if not claim.holds]
    assert [claim.name for claim in failed] == [name]
    wrong = [case for case in failed[0].exceptions if case.paper]
    assert [case.scene for case in wrong] == [where["scene"]]


def test_a_claim_without_figures_neither_holds_nor_fails(printed: list[pd.DataFrame]) -> None:
    printed[1] = printed[1].assign(ours=math.nan)
    claims = claims_of(*printed)
    assert claims["interval-below-one"].holds is None
    assert claims["depth"].holds


def test_the_papers_order_of_heuristics_is_its_own(printed: list[pd.DataFrame]) -> None:
    ranks = tables.rank_correlations(printed[2])
    assert len(ranks) == 15
    assert ranks["spearman"].to_numpy() == pytest.approx(1)
    assert ranks["kendall"].to_numpy() == pytest.approx(1)


def test_ranks_compare_what_is_printed(printed: list[pd.DataFrame]) -> None:
    # What the decimals behind the printed one say changes no order.
    noisy = printed[2].assign(ours=printed[2]["ours"] + 0.04)
    assert tables.rank_correlations(noisy)["spearman"].to_numpy() == pytest.approx(1)


def test_gains_leave_out_how_coherent_a_scene_is(printed: list[pd.DataFrame]) -> None:
    gains = tables.gains(printed[2].assign(ours=printed[2]["ours"] * 3))
    assert gains["ours"].to_numpy() == pytest.approx(gains["paper"].to_numpy())
    assert (gains[gains["heuristic"] == "none"]["ours"] == 1).all()


def test_what_the_scene_explains_is_told_from_what_the_model_does(
    printed: list[pd.DataFrame],
) -> None:
    table4 = printed[2].assign(ours=printed[2]["ours"] * 1.5, difference=0.5)
    [first, *_] = explain.scene_or_model(table4, tables.gains(table4))
    assert "off by 50% in the median" in first
    assert "by 0%" in first


def test_all_runs_are_distinct_and_cover_every_table() -> None:
    runs = list(dict.fromkeys(PLAN.all_runs()))
    assert len({(run.scene.name, run.settings) for run in runs}) == len(runs)
    for scene in PLAN.scenes:
        assert PLAN.coherence(scene, 3, "opos") in runs
        assert PLAN.packet(scene, 64) in runs
        assert PLAN.frame_rate(scene, "dir") in runs
    for scene in PLAN.hardware_scenes():
        assert {PLAN.machine(scene, machine) for machine in PLAN.machines()} <= set(runs)
    assert dict(PLAN.coherence(PLAN.scenes[0], 1, "none").settings)["measure.coherence"] is True
    assert dict(PLAN.frame_rate(PLAN.scenes[0], "dir").settings)["run.fidelity"] == "timed"


def test_an_unsorted_packet_of_sixteen_is_one_run_for_three_tables() -> None:
    scene = PLAN.scenes[2]
    assert PLAN.packet(scene, 16) == PLAN.traversal(scene, "masked")
    assert PLAN.packet(scene, 16) == PLAN.coherence(scene, 1, "none")


def test_views_are_runs_of_their_own() -> None:
    views = PLAN.views()
    assert {scene.stands_for for scene in views.scenes} == {"fairy", "newtree"}
    for view in views.scenes:
        base = next(scene for scene in PLAN.scenes if scene.name == view.stands_for)
        assert views.coherence(view, 1, "dir") != PLAN.coherence(base, 1, "dir")
    assert set(views.coherence(views.scenes[0], 1, "dir").settings) > set(views.scenes[0].settings)


def machines(times: dict[str, float]) -> pd.DataFrame:
    rows = [
        {
            "scene": "dragon",
            "memory": "DDR4",
            "heuristic": sorting.split(" ")[0],
            "cells": int(sorting.split(" ")[-1]) if " " in sorting else 0,
            "sorting": sorting,
            "cycles_relative": time,
            "p_t_relative": 1.1,
            "bytes_per_ray_relative": 1.25,
            "energy_relative": math.nan,
        }
        for sorting, time in times.items()
    ]
    return pd.DataFrame(rows)


def test_sorting_pays_if_the_best_machine_saves_more_than_a_percent() -> None:
    frame = machines({"none": 1.0, "dir × 8": 0.98, "mdir(96) × 96": 1.3})
    [verdict] = hardware.verdicts(frame)
    assert verdict.pays
    assert verdict.best == "dir × 8"
    said = " ".join(answer.answer(frame, [verdict]))
    assert "in 1 of 1 pairs of scene and memory: dragon with DDR4 (dir × 8)" in said
    assert "2.0% shorter" in said
    assert "p_t is 10% higher than without, and DRAM traffic a ray 25% higher" in said
    assert "DDR4 0.98" in said
    assert "energy" not in said


def test_the_answer_tells_what_the_size_of_the_ray_cache_does() -> None:
    frame = machines({"none": 1.0, "mdir(96) × 8": 1.16, "mdir(96) × 96": 1.05, "dir × 8": 1.0})
    said = " ".join(answer.answer(frame, hardware.verdicts(frame)))
    assert "mdir(96) with 8, 96 cells takes 1.16, 1.05." in said


def test_sorting_does_not_pay_for_less_than_a_percent() -> None:
    frame = machines({"none": 1.0, "dir × 8": 0.995})
    [verdict] = hardware.verdicts(frame)
    assert not verdict.pays
    assert "in 0 of 1 pairs of scene and memory." in " ".join(answer.answer(frame, [verdict]))


@pytest.mark.parametrize(
    ("value", "text"),
    [(5.234, "5.23"), (0.05678, "0.0568"), (12345.6, "12,346"), (100.0, "100"), (math.nan, "")],
)
def test_numbers_have_three_digits(value: float, text: str) -> None:
    assert grids.number(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.124, "+12%"), (-0.3, "−30%"), (-0.004, "0%"), (0.0, "0%"), (math.nan, "")],
)
def test_differences_have_a_sign_unless_there_is_none(value: float, text: str) -> None:
    assert grids.percent(value) == text


def test_a_cell_says_how_far_it_is_from_the_paper() -> None:
    cell = grids.compared(4.5, 5.0)
    assert (cell.ours, cell.paper, cell.difference) == ("4.50", "5.00", "−10%")
    assert cell.shade == grids.compared(5.5, 5.0).shade != grids.compared(9.0, 5.0).shade
    assert grids.compared(4.5, math.nan) == grids.Cell("4.50")


@pytest.mark.parametrize("text", ["640", "x480", "640x480x2", "-1x5", "9" * 5000 + "x1"])
def test_a_size_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ExploreError, match="expected WIDTHxHEIGHT"):
        parse_size(text)


@pytest.mark.parametrize(
    ("size", "key"),
    [("99999x99999", "image."), ("640x16385", "image.height"), ("0x5", "image.width")],
)
def test_a_size_that_the_simulator_refuses_is_refused_before_anything_runs(
    explore: Explore, sheaf: Path, tmp_path: Path, size: str, key: str
) -> None:
    words = ["paper", "--scenes", "dragon", "--size", size, "--out", tmp_path / "out"]
    done = explore(*words, "--sheaf", sheaf)
    assert done.returncode == 2
    [line] = done.stderr.splitlines()
    assert line.startswith(f"explore: --size {size}: ")
    assert key in line and "16384" in line
    assert not (tmp_path / "out").exists()


def test_unknown_scenes_and_missing_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ExploreError, match="no scene 'lion'; there are dragon"):
        choose_scenes("dragon,lion", None, None)
    with pytest.raises(ExploreError, match="is no file"):
        choose_scenes("dragon", tmp_path / "sponza.glb", None)


def test_the_page_names_the_whole_command_that_writes_it() -> None:
    real = [Scene(f"{name} (real)", Path("x.glb"), name) for name in ("sponza", "dragon")]
    plan = replace(PLAN, scenes=(*PLAN.scenes, *real), width=640, height=480)
    command = "explore paper --sponza FILE --dragon FILE --docs explore/docs"
    assert plan.command_line() == command
    committed = (Path(__file__).parents[1] / "docs/paper.md").read_text()
    assert f"    build/venv/bin/{command}\n" in committed
    assert "--scenes dragon --size 64x48" in replace(PLAN, scenes=PLAN.scenes[:1]).command_line()


def test_the_real_models_are_made_reflecting(tmp_path: Path) -> None:
    model = tmp_path / "model.glb"
    model.write_bytes(b"")
    [stand_in, real] = choose_scenes("sponza", model, None)
    assert not stand_in.real
    assert real.real
    assert real.stands_for == "sponza"
    assert dict(real.settings) == {"scene.reflectance": 0.5}
    plan = replace(PLAN, scenes=(stand_in, real))
    assert ("scene.reflectance", 0.5) in plan.coherence(real, 1, "dir").settings
    assert plan.varied_scenes() == [stand_in]
