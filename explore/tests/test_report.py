# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The table and the report: numbers, plots, links, and the page in a browser."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest
from conftest import Explore

from sheaf_explore.collect import collect
from sheaf_explore.derived import derive
from sheaf_explore.simulator import Simulator
from sheaf_explore.store import Store

Write = Callable[[str], Path]
SPEC = """name = "ways </script> & <latency>"
scenes = ["scene.glb"]
[[axis]]
key = "l2.ways"
range = "1..32 x2"
[[axis]]
key = "dram.latency"
values = [13, 20, 40]
"""


@pytest.fixture
def swept(explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path) -> Path:
    out = tmp_path / "out"
    spec = write_spec(SPEC)
    assert explore("sweep", spec, "--sheaf", stand_in.path, "--out", out).returncode == 1
    return out


def test_the_table_has_a_row_a_point_and_a_column_a_number(explore: Explore, swept: Path) -> None:
    assert explore("collect", swept).returncode == 0
    frame = pd.read_parquet(swept / "results.parquet")
    assert len(frame) == 12
    row = frame[(frame["l2.ways"] == 4) & (frame["dram.latency"] == 40)].iloc[0]
    assert row["system.cycles"] == 404
    assert row["derived.dram_bytes"] == row["system.dram.bytes_read"] == 2499
    pd.testing.assert_frame_equal(pd.read_csv(swept / "results.csv"), frame, check_dtype=False)
    schema = pq.read_schema(swept / "results.parquet")
    assert schema.field("system.cycles").metadata[b"unit"] == b"cycles"
    assert "system.cycles,cycles" in (swept / "columns.csv").read_text().splitlines()


def test_collecting_again_gives_the_same_bytes(explore: Explore, swept: Path) -> None:
    def files() -> list[bytes]:
        explore("collect", swept)
        return [(swept / f"results.{kind}").read_bytes() for kind in ("csv", "parquet")]

    assert files() == files()


def test_counters_are_told_from_settings(swept: Path) -> None:
    counters = collect(Store(swept)).counters()
    assert "system.cycles" in counters
    assert "l2.ways" not in counters


def test_collecting_nothing_is_refused(explore: Explore, tmp_path: Path) -> None:
    done = explore("collect", tmp_path)
    assert done.returncode == 2
    assert "is no sweep" in done.stderr


def test_a_damaged_result_is_named(explore: Explore, swept: Path) -> None:
    victim = next((swept / "points").iterdir()) / "stats.json"
    victim.write_text("{")
    done = explore("collect", swept)
    assert done.returncode == 2
    assert str(victim) in done.stderr


def test_derived_columns_sum_over_units_and_take_the_models_own_sram() -> None:
    counters = {
        "system.traversal_unit0.node_cache.num_accesses": 8,
        "system.traversal_unit0.node_cache.num_hits": 6,
        "system.traversal_unit1.node_cache.num_accesses": 2,
        "system.traversal_unit1.node_cache.num_hits": 1,
        "area.sram_bits": 4711,
    }
    derived = derive(counters)
    assert derived["derived.node_cache.hit_rate"] == (0.7, "1")
    assert derived["derived.sram_bits"] == (4711, "bits")
    assert "derived.sram_bits" not in derive({})


def test_a_report_is_one_page_with_plots_and_links(explore: Explore, swept: Path) -> None:
    assert explore("report", swept).returncode == 0
    report = swept / "report"
    page = (report / "index.html").read_text()
    assert "12 of 18 points have results, 6 failed" in page
    assert "12 traced their scene live, 0 replayed" in page
    assert "dram.latency = 13 is bad luck" in page
    for address in re.findall(r'href="(\.\./[^"]+)"', page):
        assert (report / address).exists(), address
    pictures = [p for p in report.iterdir() if p.suffix == ".png"]
    assert len(pictures) >= 4
    for picture in pictures:
        assert picture.read_bytes().startswith(b"\x89PNG")
        assert picture.with_suffix(".svg").read_text().startswith("<svg")


OUTPUTS = """scenes = ["tiny.gltf"]
replay = true
[set]
image = { width = 8, height = 6 }
[outputs]
images = false
timeline = true
timeline_window = "0..5000"
[[axis]]
key = "l2.ways"
values = [4, 8]
[[axis]]
key = "render.recursion_level"
values = [0]
[[axis]]
key = "run.fidelity"
values = ["timed", "functional"]
"""


@pytest.mark.parametrize("replay", ["true", "false"])
def test_points_leave_what_the_spec_says_and_the_report_links_it(
    explore: Explore, sheaf: Path, tiny_scene: Path, tmp_path: Path, replay: str
) -> None:
    spec, out = tiny_scene.with_name("spec.toml"), tmp_path / "out"
    spec.write_text(OUTPUTS.replace("true", replay, 1))
    done = explore("sweep", spec, "--sheaf", sheaf, "--out", out)
    assert done.returncode == 0, done.stderr
    for point in (out / "points").iterdir():
        timed = 'fidelity = "timed"' in (point / "config.toml").read_text()
        assert (point / "timeline.perfetto-trace").exists() == timed
        assert not list(point.glob("*.png")) + list(point.glob("*.exr"))
    assert explore("report", out).returncode == 0
    page = (out / "report" / "index.html").read_text()
    links = re.findall(r'href="(\.\./[^"]+)"', page)
    assert all((out / "report" / address).exists() for address in links)
    assert sum(address.endswith("timeline.perfetto-trace") for address in links) == 2
    assert "open it with" in page
    assert not [address for address in links if "image" in address]


def test_a_report_without_timelines_does_not_speak_of_them(explore: Explore, swept: Path) -> None:
    assert explore("report", swept).returncode == 0
    assert "timeline" not in (swept / "report" / "index.html").read_text().split("<script>")[0]


@pytest.mark.parametrize(("outputs", "line"), [("images = false\n", 3), ("\ntimeline = true\n", 4)])
def test_a_simulator_that_cannot_write_what_is_asked_for_is_told_with_file_and_line(
    explore: Explore,
    write_spec: Write,
    stand_in: Simulator,
    tmp_path: Path,
    outputs: str,
    line: int,
) -> None:
    spec = write_spec('scenes = ["scene.glb"]\n[outputs]\n' + outputs)
    done = explore("sweep", spec, "--sheaf", stand_in.path, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert f"{spec}:{line}: " in done.stderr
    assert "has no option --" in done.stderr


_CHROMIUMS_OWN = re.compile(r"(^|\.)(google|googleapis|gvt1|gstatic)\.com$")
CHROMIUM = shutil.which("chromium")


def browse(page: Path, tmp_path: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Opens a page in headless Chromium that may not look up any host."""
    command = [str(CHROMIUM), "--headless=new", "--no-sandbox", "--disable-gpu"]
    command += ["--hide-scrollbars", "--enable-logging=stderr", "--log-level=0"]
    command += ["--virtual-time-budget=15000", f"--user-data-dir={tmp_path / 'profile'}"]
    command += ["--window-size=1280,2600", "--host-resolver-rules=MAP * ~NOTFOUND"]
    command += [f"--log-net-log={tmp_path / 'net.json'}", *words, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


@pytest.mark.browser
@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
def test_a_browser_draws_every_plot_without_errors_or_network(
    explore: Explore, swept: Path, tmp_path: Path
) -> None:
    explore("report", swept)
    done = browse(swept / "report" / "index.html", tmp_path, "--dump-dom")
    assert done.returncode == 0, done.stderr
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    assert not console
    charts = re.findall(r'class="chart[^"]*" id="chart-([^"]+)"([^>]*)', done.stdout)
    assert len(charts) >= 5
    assert all('data-drawn="yes"' in attributes for _, attributes in charts)
    assert done.stdout.count('class="marks"') == len(charts)
    # Chromium looks for its own updates and dictionaries; the page asks for nothing but files.
    asked = re.findall(r'"url":"(?:https?|wss?)://([^/"]+)', (tmp_path / "net.json").read_text())
    assert not [host for host in asked if not _CHROMIUMS_OWN.search(host)]
