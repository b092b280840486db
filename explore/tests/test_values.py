# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Quantities, parameters, ranges and conditions."""

from __future__ import annotations

import json

import pytest
from conftest import SCHEMA

from sheaf_explore.conditions import Condition
from sheaf_explore.errors import ExploreError
from sheaf_explore.parameters import Parameters
from sheaf_explore.quantities import (
    format_bytes,
    format_frequency,
    is_window,
    parse_bytes,
    parse_duration,
    parse_frequency,
)
from sheaf_explore.ranges import Continuum, parse_range

PARAMETERS = Parameters(json.loads(SCHEMA))


@pytest.mark.parametrize("text", ["1B", "4KiB", "100B", "3MiB", "1025KiB", "7TiB"])
def test_bytes_are_written_as_they_are_read(text: str) -> None:
    count = parse_bytes(text)
    assert count is not None
    assert format_bytes(count) == text


@pytest.mark.parametrize("text", ["", "KiB", "-4KiB", "4kB", "1.5KiB", "4 K iB", "1e3", "٣"])
def test_what_is_no_size_is_not_read_as_one(text: str) -> None:
    assert parse_bytes(text) is None


@pytest.mark.parametrize("hertz", [1e9, 1.5e9, 8e8, 333333333.333, 1e12])
def test_frequencies_survive_writing_and_reading(hertz: float) -> None:
    assert parse_frequency(format_frequency(hertz)) == hertz


def test_durations_have_units() -> None:
    assert [parse_duration(t) for t in ("90s", "10min", "1.5h", "3", "3 days")] == [
        90,
        600,
        5400,
        3,
        None,
    ]


def test_windows_are_those_that_the_simulator_takes() -> None:
    good = ["0..1", "..9", "5..", "..", "10000..20000"]
    assert all(is_window(text) for text in good)
    bad = [
        "",
        "5",
        "9..9",
        "9..5",
        "a..b",
        "..0",
        "1..2..3",
        "-1..5",
        "0..٣",
        "1..9999999999999999999",
    ]
    assert not any(is_window(text) for text in bad)


def test_all_ways_to_write_a_size_are_one_value() -> None:
    check = PARAMETERS["l2.capacity"].check
    assert check("64KiB") == check("65536B") == check("64 KiB") == check(65536) == 65536


@pytest.mark.parametrize(
    ("key", "raw"),
    [
        ("l2.capacity", "3 apples"),
        ("l2.capacity", 1),
        ("l2.capacity", "2B"),
        ("l2.ways", 0),
        ("l2.ways", 1.5),
        ("l2.ways", True),
        ("l2.mode", "gone"),
        ("render.weight_cutoff", float("nan")),
        ("render.weight_cutoff", float("inf")),
        ("ray_cache.heuristic", 5),
    ],
)
def test_values_outside_a_parameters_range_are_refused(key: str, raw: object) -> None:
    with pytest.raises(ExploreError, match=r"is refused: expected"):
        PARAMETERS[key].check(raw)


def test_an_unknown_key_names_the_nearest() -> None:
    with pytest.raises(ExploreError, match=r"did you mean 'l2\.capacity'"):
        PARAMETERS["l2.capacty"]


@pytest.mark.parametrize(
    ("key", "text", "expected"),
    [
        ("l2.capacity", "4KiB..64KiB x2", [4096, 8192, 16384, 32768, 65536]),
        ("l2.capacity", "4KiB..20KiB +8KiB", [4096, 12288, 20480]),
        ("l2.capacity", "4KiB .. 60KiB  x 4", [4096, 16384]),
        ("l2.ways", "1..4", [1, 2, 3, 4]),
        ("l2.ways", "1..16 +5", [1, 6, 11, 16]),
        ("l2.ways", "3..3", [3]),
        ("dram.latency", "10..10000 x10", [10, 100, 1000, 10000]),
        ("render.weight_cutoff", "0..0.3 +0.1", [0, 0.1, 0.2, pytest.approx(0.3)]),
        ("clock.frequency", "1GHz..4GHz x2", [1e9, 2e9, 4e9]),
    ],
)
def test_ranges_include_both_ends_where_the_steps_meet_them(
    key: str, text: str, expected: list[object]
) -> None:
    assert parse_range(PARAMETERS[key], text) == expected


def test_a_range_of_reals_without_steps_is_a_continuum() -> None:
    linear = parse_range(PARAMETERS["render.weight_cutoff"], "0.0..0.5")
    assert linear == Continuum(0.0, 0.5, False)
    logarithmic = parse_range(PARAMETERS["dram.latency"], "10..1000 log")
    assert isinstance(logarithmic, Continuum)
    assert logarithmic.at(0.5) == pytest.approx(100)


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("l2.ways", "4..1"),
        ("l2.ways", "1..8 x1"),
        ("l2.ways", "1..8 x0.5"),
        ("l2.ways", "1..8 +0"),
        ("l2.ways", "1..8 xinf"),
        ("l2.ways", "1..5 x1.5"),
        ("l2.ways", "one..two"),
        ("l2.ways", "5"),
        ("l2.ways", "1..2000"),
        ("l2.mode", "normal..absent"),
        ("ray_cache.cells", "0..8 x2"),
        ("render.weight_cutoff", "0..1 log"),
        ("dram.latency", "1..1000000"),
    ],
)
def test_ranges_without_sense_are_refused(key: str, text: str) -> None:
    with pytest.raises(ExploreError):
        parse_range(PARAMETERS[key], text)


VALUES = {"l2.ways": 8, "l2.capacity": 65536, "ray_cache.heuristic": "dir", "packet.size": 16}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("l2.capacity == '64KiB'", True),
        ("l2.capacity / l2.ways < 8192", False),
        ("ray_cache.heuristic in ['dir', 'none'] and not l2.ways > 8", True),
        ("1 < l2.ways <= 8 or packet.size % 3 == 0", True),
        ("max(l2.ways, packet.size) - min(1, abs(-2)) != 15", False),
        ("ray_cache.heuristic != 'none'", True),
    ],
)
def test_conditions_compare_keys(text: str, expected: bool) -> None:
    assert Condition(text).holds(VALUES) is expected


def test_a_condition_knows_which_keys_it_asks_for() -> None:
    assert Condition("l2.ways * packet.size > max(l2.capacity, 3)").names == {
        "l2.ways",
        "packet.size",
        "l2.capacity",
    }


@pytest.mark.parametrize(
    "text",
    [
        "",
        "l2.ways =",
        "__import__('os').system('true')",
        "().__class__",
        "l2.ways ** 9",
        "[x for x in 'ab']",
        "lambda: 1",
        "f'{l2}'",
        "open('x')",
        "max(l2.ways, key=abs)",
        "l2['ways'] > 1",
        "(" * 300 + "1" + ")" * 300,
        "1 +" * 400 + "1",
    ],
)
def test_conditions_allow_nothing_but_comparisons(text: str) -> None:
    with pytest.raises(ExploreError):
        Condition(text)


@pytest.mark.parametrize("text", ["l2.ways / 0 > 1", "ray_cache.heuristic * 9 == 1", "'a' < 1"])
def test_a_condition_that_cannot_be_computed_says_so(text: str) -> None:
    with pytest.raises(ExploreError, match="cannot be computed"):
        Condition(text).holds(VALUES)
