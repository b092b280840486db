# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""explore paper from end to end, at a tiny size on scenes of a few triangles."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import pandas as pd
import pytest
from conftest import Explore
from scene_maker import stairs, tiny_gltf
from test_report import browse, CHROMIUM

from sheaf_explore.paper import command, plan

SCENES = ("newtree", "sponza")
MEMORIES = {name: plan.MEMORIES[name] for name in ("perfect caches", "DDR4")}


def glb(document: str) -> bytes:
    """A glTF document as a binary file of one chunk."""
    text = document.encode()
    text += b" " * (-len(text) % 4)
    chunk = struct.pack("<I4s", len(text), b"JSON") + text
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunk)) + chunk


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the module's one report is made."""
    return tmp_path_factory.mktemp("paper")


@pytest.fixture
def made(explore: Explore, sheaf: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The report, made by the first test that asks for it."""
    for name in SCENES:
        (folder / f"{name}.glb").write_bytes(glb(tiny_gltf(stairs(6))))
    monkeypatch.setattr(command, "_folder_of_scenes", lambda: folder)
    # Fewer machines and variants: each is made the same way.
    monkeypatch.setattr(plan, "MEMORIES", MEMORIES)
    monkeypatch.setattr(plan, "VARIANTS", (*plan.VARIANTS[:2], plan.VARIANTS[-1]))
    out = folder / "out"
    words = ["paper", "--scenes", ",".join(SCENES), "--size", "16x12", "--out", out]
    done = explore(*words, "--docs", folder / "docs", "--sheaf", sheaf)
    assert done.returncode == 0, done.stderr
    return out


def test_a_report_has_every_table_and_every_figure(made: Path) -> None:
    page = (made / "index.html").read_text()
    for number in (1, 2, 3, 4):
        assert f"Table {number}: " in page
        assert len(pd.read_csv(made / f"table{number}.csv")) > 0
    for number in (2, 5, 6, 7):
        assert f"Figure {number}: " in page
        assert (made / f"paper-figure{number}.png").read_bytes().startswith(b"\x89PNG")
    for anchor in re.findall(r'href="#([^"]+)"', page):
        assert f'id="{anchor}"' in page
    for address in re.findall(r'href="([^"#:]+)"', page):
        assert (made / address).exists() or address == "data", address


def test_a_page_of_documentation_has_its_images_and_whole_tables(made: Path) -> None:
    folder = made.parent / "docs"
    page = (folder / "paper.md").read_text()
    names = ",".join(SCENES)
    assert f"explore paper --scenes {names} --size 16x12 --docs explore/docs\n" in page
    images = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", page)
    assert len(images) >= 9
    assert all((folder / image).read_text().startswith("<svg") for image in images)
    tables = re.findall(r"(?:^\|.*\|\n)+", page, re.MULTILINE)
    assert len(tables) >= 10
    for table in tables:
        assert len({line.count("|") for line in table.splitlines()}) == 1, table


def test_all_heuristics_find_the_same_rays(made: Path) -> None:
    table4 = pd.read_csv(made / "table4.csv")
    own = table4[(table4["scene"] == "sponza") & (table4["measure"] == "c_t")]
    assert not own["ours"].isna().any()
    assert (own.groupby("level")["ours"].nunique() == 1).all()
    assert not table4[table4["measure"] == "p_t"]["ours"].isna().any()


def test_hardware_is_compared_with_none_of_the_same_memory(made: Path) -> None:
    machines = pd.read_csv(made / "machines.csv")
    assert set(machines["memory"]) == set(MEMORIES)
    assert set(machines["scene"]) == {"sponza"}
    assert (machines[machines["sorting"] == "none"]["cycles_relative"] == 1).all()
    assert machines["cycles"].min() > 0


def test_again_it_simulates_nothing_and_writes_the_same(
    made: Path, explore: Explore, sheaf: Path
) -> None:
    journal = (made / "runs" / "journal.jsonl").read_bytes()
    page = (made / "index.html").read_bytes()
    words = ["paper", "--scenes", ",".join(SCENES), "--size", "16x12", "--out", made]
    assert explore(*words, "--sheaf", sheaf).returncode == 0
    assert (made / "runs" / "journal.jsonl").read_bytes() == journal
    assert (made / "index.html").read_bytes() == page


@pytest.mark.browser
@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
def test_a_browser_draws_every_figure(made: Path, tmp_path: Path) -> None:
    done = browse(made / "index.html", tmp_path, "--dump-dom")
    assert done.returncode == 0, done.stderr
    assert not [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    charts = re.findall(r'class="chart[^"]*" id="chart-([^"]+)"([^>]*)', done.stdout)
    assert len(charts) >= 9
    assert all('data-drawn="yes"' in attributes for _, attributes in charts)
