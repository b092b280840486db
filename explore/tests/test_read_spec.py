# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Specs: what is read, and that every refusal names file and line."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Explore, SCHEMA

from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameters
from sheaf_explore.read_spec import read_spec
from sheaf_explore.simulator import Simulator
from sheaf_explore.toml_lines import line_of

PARAMETERS = Parameters(json.loads(SCHEMA))
Write = Callable[[str], Path]

GOOD = """name = "good"
scenes = ["scene.glb"]
drop = ["l2.ways > 8 and l2.capacity < '64KiB'"]
[set]
image.width = 32
"ray_cache.cells" = 8
[limits]
time = "2min"
memory = "1GiB"
[[axis]]
key = "l2.capacity"
range = "16KiB..64KiB x2"
[[axis]]
key = "l2.ways"
values = [4, 16]
[[axis]]
name = "shape"
zip = { packet.size = [4, 8], packet_fifo.depth = [8, 4] }
[[axis]]
name = "memory"
[axis.presets.slow]
dram.latency = 300
[axis.presets.fast]
dram = { latency = 50 }
"""


def test_a_spec_says_scenes_settings_axes_limits_and_conditions(write_spec: Write) -> None:
    spec = read_spec(write_spec(GOOD), PARAMETERS)
    assert spec.name == "good"
    assert [s.name for s in spec.sources] == ["scene.glb"]
    assert spec.settings == {"image.width": 32, "ray_cache.cells": 8}
    assert (spec.limits.seconds, spec.limits.memory, spec.limits.retries) == (120, 2**30, 2)
    assert [a.name for a in spec.axes] == ["l2.capacity", "l2.ways", "shape", "memory"]
    assert [c.label for c in spec.axes[0].choices] == [16384, 32768, 65536]
    assert spec.axes[2].choices[1].settings == {"packet.size": 8, "packet_fifo.depth": 4}
    assert spec.axes[3].choices[1].settings == {"dram.latency": 50}


HEAD = 'scenes = ["scene.glb"]\n'


@pytest.mark.parametrize(
    ("text", "line", "problem"),
    [
        ("x = 1\n" + HEAD, 1, "unknown key 'x'"),
        ("\n\nscenes = ['missing.glb']\n", 3, "no file"),
        ("name = 'none'\n", 1, "nothing to simulate"),
        (HEAD + "traces = ['scene.glb']\n", 2, "named twice"),
        (HEAD + "# remark\n[set]\nl2.ways = 8\nl2.wayz = 8\n", 5, "did you mean 'l2.ways'"),
        (HEAD + "[set]\nl2.ways = 0\n", 3, "from 1 to 1024"),
        (HEAD + "[set]\nl2.ways = 4\n'l2.ways' = 8\n", 4, "set twice"),
        (HEAD + "[[axis]]\nkey = 'l2.ways'\nvalues = [\n1,\n2,\n'x',\n]\n", 4, "is refused"),
        (HEAD + "[[axis]]\nkey = 'l2.ways'\nvalues = [1, 2, 1]\n", 2, "stands there twice"),
        (HEAD + "[[axis]]\nkey = 'l2.ways'\nvalues = []\n", 2, "no values"),
        (HEAD + "[[axis]]\nkey = 'l2.ways'\nrange = '8..1'\n", 4, "ends before it begins"),
        (HEAD + "[[axis]]\nkey = 'l2.ways'\n", 2, "one of values, range, zip and presets"),
        (HEAD + "[[axis]]\nvalues = [1]\n", 2, "does not say what it varies"),
        (HEAD + "[[axis]]\nkey = 'l2'\nvalues = [1]\n", 3, "unknown key 'l2'"),
        (HEAD + "[[axis]]\nkey = 'dram.latency'\nrange = '1..9 log'\n", 4, "[sample]"),
        (
            HEAD
            + "[[axis]]\nkey='l2.ways'\nvalues=[1]\n\n# two\n[[axis]]\nkey='l2.ways'\nvalues=[2]\n",
            7,
            "two axes",
        ),
        (HEAD + "[set]\nl2.ways = 1\n[[axis]]\nkey='l2.ways'\nvalues=[2]\n", 4, "in [set] as well"),
        (HEAD + "[[axis]]\nzip = { l2.ways = [1, 2], packet.size = [1] }\n", 3, "of one length"),
        (HEAD + "[[axis]]\n[axis.presets.a]\nl2.ways = 1\n", 3, "needs a name"),
        (HEAD + "drop = ['l2.way > 1']\n", 2, "did you mean"),
        (HEAD + "drop = ['import os']\n", 2, "no condition"),
        (HEAD + "[sample]\npoints = 0\n", 3, "points must be"),
        (HEAD + "[sample]\nmethod = 'sobol'\npoints = 3\n", 3, "method must be"),
        (HEAD + "[limits]\ntime = 'soon'\n", 3, "duration"),
        (HEAD + "[limits]\nretries = -1\n", 3, "retries"),
        (HEAD + "[outputs]\nimages = false\nvideo = true\n", 4, "unknown key 'video'"),
        (HEAD + "[outputs]\nimages = 0\n", 3, "images must be true or false"),
        (HEAD + "[outputs]\ntimeline_window = '0..9'\n", 3, "there is no timeline"),
        (HEAD + "[outputs]\ntimeline = true\ntimeline_window = '9..9'\n", 4, "FIRST < END"),
        (HEAD + "outputs = 'all'\n", 2, "outputs must be a table"),
        (HEAD + "[optimize]\nbudget = 10\n", 2, "minimize or maximize"),
        (HEAD + "set = 3\n", 2, "set must be a table"),
        (HEAD + "axis = [1]\n", 2, "[[axis]]"),
    ],
)
def test_refusals_name_file_and_line(write_spec: Write, text: str, line: int, problem: str) -> None:
    path = write_spec(text)
    with pytest.raises(ExploreError) as caught:
        read_spec(path, PARAMETERS)
    message = str(caught.value)
    assert message.startswith(f"{path}:{line}: ")
    assert problem in message
    assert "\n" not in message


def test_a_file_that_is_no_toml_is_refused_with_its_line(write_spec: Write) -> None:
    path = write_spec("scenes = [\n'a'\n[set\n")
    with pytest.raises(ExploreError, match=re.escape(str(path)) + r".*line 3"):
        read_spec(path, PARAMETERS)


def test_a_spec_that_is_not_there_or_no_text_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ExploreError, match="cannot be read"):
        read_spec(tmp_path / "none.toml", PARAMETERS)
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ExploreError, match="no UTF-8"):
        read_spec(tmp_path / "binary.toml", PARAMETERS)


def test_lines_are_found_behind_texts_and_lists_of_several_lines() -> None:
    text = 'a = """\nb = 1\n"""\nlist = [\n 1,\n]\n\n[t]\nb.c = 2\n[[u]]\nx = 1\n[[u]]\nx = 2\n'
    assert line_of(text, ("a",)) == 1
    assert line_of(text, ("list", 0)) == 4
    assert line_of(text, ("t", "b", "c")) == 9
    assert line_of(text, ("u", 1, "x")) == 13
    assert line_of(text, ("u", 1, "gone")) == 12


def test_the_command_refuses_before_anything_runs(
    explore: Explore, write_spec: Write, stand_in: Simulator, tmp_path: Path
) -> None:
    path = write_spec(HEAD + "[[axis]]\nkey = 'l2.wayz'\nvalues = [1]\n")
    done = explore("sweep", path, "--sheaf", stand_in.path, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert f"{path}:3: unknown key" in done.stderr
    assert not (stand_in.path.parent / "starts").exists()
    assert not (tmp_path / "out").exists()
