# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The reader of traces, on those that stand in traces/, against what the simulator says of them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from conftest import CHECKOUT

from sheaf_explore.cli import main
from sheaf_explore.errors import ExploreError
from sheaf_explore.traces import read_tables, Trace

TRACES = CHECKOUT / "traces"


def test_every_ray_but_primary_ones_was_spawned_by_another() -> None:
    tables = read_tables(TRACES / "sponza-rays.trace")
    rays, spawned = tables["rays"], tables["spawned"]
    metadata = Trace(TRACES / "sponza-rays.trace").metadata
    pixels = metadata["image"]["width"] * metadata["image"]["height"]
    primary = rays[rays["kind"] == "primary"]
    assert len(primary) == pixels == primary["pixel"].nunique()
    assert set(rays.loc[rays["kind"] != "primary", "id"]) <= set(spawned["id"])
    assert set(spawned["parent"]) <= set(rays["id"])
    assert len(primary) + len(spawned) == metadata["rays"]


def test_directions_are_unit_vectors() -> None:
    spawned = read_tables(TRACES / "sponza-rays.trace")["spawned"]
    length = np.linalg.norm(spawned[["direction_x", "direction_y", "direction_z"]], axis=1)
    np.testing.assert_allclose(length, 1, atol=1e-5)


@pytest.mark.parametrize("name", ["sponza-memory", "dragon-memory"])
def test_accesses_are_in_order_and_chains_whole(name: str) -> None:
    trace = Trace(TRACES / f"{name}.trace")
    tables = read_tables(trace.path)
    accesses, chains = tables["accesses"], tables["chains"]
    assert len(accesses) == trace.records
    assert accesses["begins"].sum() == accesses["ends"].sum() == len(chains)
    for _, stream in accesses.groupby("stream"):
        assert (stream["record"] == np.arange(len(stream))).all()
        assert stream["cycle"].is_monotonic_increasing
    last = accesses.groupby("stream")["record"].max()
    caused = chains[chains["cause"] != ""]
    assert (caused["cause_record"] <= caused["cause"].map(last)).all()
    assert accesses["cycle"].max() < trace.metadata["cycles"]
    assert set(accesses.loc[accesses["write"], "kind"]) == {"pixel"}


def test_parquet_gives_the_same_tables(tmp_path: Path) -> None:
    source = TRACES / "dragon-memory.trace"
    with pytest.raises(SystemExit) as ended:
        run = ["explore", "trace", str(source), "--parquet", str(tmp_path / "out")]
        _run(run)
    assert ended.value.code in (0, None)
    for name, table in read_tables(source).items():
        pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "out" / f"{name}.parquet"), table)


def _run(arguments: list[str]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", arguments)
        main()


def test_damage_is_refused_with_its_place(tmp_path: Path) -> None:
    good = (TRACES / "dragon-memory.trace").read_bytes()
    damaged = tmp_path / "damaged.trace"
    for at in [
        *range(0, 160, 3),
        *range(160, len(good), 9973),
        *range(len(good) - 48, len(good), 3),
    ]:
        damaged.write_bytes(good[:at] + bytes([good[at] ^ 1]) + good[at + 1 :])
        with pytest.raises(ExploreError, match=r"damaged\.trace"):
            read_tables(damaged)
    for size in (0, 5, 63, 64, 200, len(good) - 1):
        damaged.write_bytes(good[:size])
        with pytest.raises(ExploreError, match=r"damaged\.trace"):
            read_tables(damaged)


def test_the_recipe_makes_the_traces_again_bit_for_bit(sheaf: Path, tmp_path: Path) -> None:
    recipe = [sys.executable, TRACES / "make_traces.py", sheaf, tmp_path]
    subprocess.run(recipe, check=True, timeout=300)
    for trace in sorted(TRACES.glob("*.trace")):
        assert (tmp_path / trace.name).read_bytes() == trace.read_bytes(), trace.name
