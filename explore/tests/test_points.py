# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Points: products, zips, samples, conditions, and their names."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from conftest import SCHEMA

from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameters
from sheaf_explore.points import expand, Point, point_id
from sheaf_explore.read_spec import read_spec

PARAMETERS = Parameters(json.loads(SCHEMA))
Write = Callable[[str], Path]
HEAD = 'scenes = ["scene.glb"]\n'
TWO_AXES = (
    "[[axis]]\nkey = 'l2.ways'\nvalues = [1, 2]\n[[axis]]\nkey = 'dram.latency'\nrange = '1..3'\n"
)


def points_of(write_spec: Write, text: str) -> list[Point]:
    return expand(read_spec(write_spec(text), PARAMETERS), PARAMETERS)


def test_axes_make_their_product_and_the_last_changes_fastest(write_spec: Write) -> None:
    places = [tuple(p.labels.values()) for p in points_of(write_spec, HEAD + TWO_AXES)]
    assert places == [(1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (2, 3)]


def test_zipped_keys_move_together(write_spec: Write) -> None:
    text = HEAD + "[[axis]]\nzip = { l2.ways = [1, 2], packet.size = [8, 4] }\n"
    settings = [p.settings for p in points_of(write_spec, text)]
    assert settings == [{"l2.ways": 1, "packet.size": 8}, {"l2.ways": 2, "packet.size": 4}]


def test_conditions_drop_points_and_see_defaults(write_spec: Write) -> None:
    text = HEAD + "drop = ['l2.ways * dram.latency > 4', 'packet.size != 16']\n" + TWO_AXES
    assert len(points_of(write_spec, text)) == 5


def test_dropping_every_point_is_refused(write_spec: Write) -> None:
    with pytest.raises(ExploreError, match="no point is left"):
        points_of(write_spec, HEAD + "drop = ['l2.ways > 0']\n" + TWO_AXES)


def test_a_product_too_large_is_refused_before_it_is_made(write_spec: Write) -> None:
    axes = "".join(
        f"[[axis]]\nkey = '{key}'\nrange = '1..{top}'\n"
        for key, top in [("l2.ways", 1000), ("dram.latency", 9999), ("packet.size", 64)]
    )
    with pytest.raises(ExploreError, match="639936000 points"):
        points_of(write_spec, HEAD + axes)


def test_points_that_repeat_a_default_are_not_run_twice(write_spec: Write) -> None:
    presets = "[axis.presets.x]\nl2.ways = 8\n[axis.presets.y]\npacket.size = 16\n"
    text = HEAD + "[[axis]]\nname = 'a'\n" + presets
    assert len(points_of(write_spec, text)) == 1


def test_a_latin_hypercube_has_one_point_in_each_share_of_each_axis(write_spec: Write) -> None:
    text = HEAD + "[sample]\npoints = 20\nseed = 3\n"
    text += "[[axis]]\nkey = 'render.weight_cutoff'\nrange = '0.0..1.0'\n"
    text += "[[axis]]\nkey = 'dram.latency'\nrange = '1..20'\n"
    points = points_of(write_spec, text)
    shares = sorted(int(float(str(p.settings["render.weight_cutoff"])) * 20) for p in points)
    assert shares == list(range(20))
    assert sorted(int(str(p.settings["dram.latency"])) for p in points) == list(range(1, 21))


def test_samples_repeat_with_their_seed_and_differ_with_another(write_spec: Write) -> None:
    for method in ("random", "latin-hypercube"):
        text = HEAD + f"[sample]\nmethod = '{method}'\npoints = 12\nseed = 5\n"
        text += "[[axis]]\nkey = 'l2.capacity'\nrange = '1KiB..1MiB log'\n"
        first, again = points_of(write_spec, text), points_of(write_spec, text)
        other = points_of(write_spec, text.replace("seed = 5", "seed = 6"))
        assert [p.settings for p in first] == [p.settings for p in again]
        assert [p.settings for p in first] != [p.settings for p in other]
        assert all(1024 <= int(str(p.settings["l2.capacity"])) <= 2**20 for p in first)


def test_a_points_name_depends_on_what_is_simulated_alone(write_spec: Write) -> None:
    point = points_of(write_spec, HEAD + TWO_AXES)[0]

    def name(p: Point, source: str = "s", binary: str = "b") -> str:
        return point_id(p, PARAMETERS, source, binary)

    same = replace(point, labels={"other": "label"}, settings=point.settings | {"packet.size": 16})
    assert name(same) == name(point)
    others = {
        name(replace(point, settings=point.settings | {"packet.size": 8})),
        name(point, source="t"),
        name(point, binary="c"),
        name(replace(point, source=replace(point.source, kind="trace"))),
    }
    assert len(others | {name(point)}) == 5


def test_outputs_are_part_of_the_name_only_where_a_spec_asks_for_them(write_spec: Write) -> None:
    l2 = {"ways": {"type": "integer", "minimum": 1, "maximum": 16, "default": 8}}
    parameters = Parameters({"properties": {"l2": {"type": "object", "properties": l2}}})

    def name(outputs: str) -> str:
        [point] = expand(read_spec(write_spec(HEAD + outputs), parameters), parameters)
        return point_id(point, parameters, "s", "b")

    plain = name("")
    identity = '{"binary":"b","configuration":{"l2.ways":8},"mode":"live","source":"s"}'
    assert plain == hashlib.sha256(identity.encode()).hexdigest()[:20]
    assert name("[outputs]\nimages = true\ntimeline = false\n") == plain
    timeline = "[outputs]\ntimeline = true\n"
    others = {name("[outputs]\nimages = false\n"), name(timeline)}
    others.add(name(timeline + "timeline_window = '0..9'\n"))
    assert len(others | {plain}) == 4


def test_a_timeline_is_asked_for_only_where_time_is_simulated(write_spec: Write) -> None:
    text = HEAD + "[outputs]\ntimeline = true\nimages = false\ntimeline_window = '5..'\n"
    [point] = points_of(write_spec, text)
    timeline = ["--timeline", "--timeline-window", "5.."]
    assert point.output_options() == ["--no-images", *timeline]
    assert replace(point, from_recording=True).output_options() == timeline
    analytic = replace(point, settings={"run.fidelity": "analytic"})
    assert analytic.output_options() == ["--no-images"]
