# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Pareto fronts and sensitivities against slow or known answers."""

from __future__ import annotations

import math
import random

import numpy as np
import pandas as pd
import pytest

from sheaf_explore.analysis import binned, pareto_front, sensitivity


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_the_front_is_what_no_other_point_beats(columns: int) -> None:
    generator = random.Random(columns)
    for _ in range(30):
        rows = [[generator.randrange(6) for _ in range(columns)] for _ in range(25)]

        def beats(a: list[int], b: list[int]) -> bool:
            return all(x <= y for x, y in zip(a, b, strict=True)) and a != b

        expected = [not any(beats(other, row) for other in rows) for row in rows]
        assert pareto_front(np.array(rows, dtype=float)).tolist() == expected


def test_points_without_a_number_are_not_on_the_front() -> None:
    front = pareto_front(np.array([[1.0, math.nan], [2.0, 2.0]]))
    assert front.tolist() == [False, True]


def test_sensitivity_of_a_sum_splits_its_variance() -> None:
    rows = [(a, b, 3.0 * a + b) for a in (0, 1) for b in (0, 1)]
    frame = pd.DataFrame(rows, columns=["a", "b", "y"])
    assert sensitivity(frame, "a", "y") == pytest.approx(0.9)
    assert sensitivity(frame, "b", "y") == pytest.approx(0.1)


def test_a_pure_interaction_is_no_axis_own() -> None:
    rows = [(a, b, a * b) for a in (-1, 1) for b in (-1, 1)]
    frame = pd.DataFrame(rows, columns=["a", "b", "y"])
    assert sensitivity(frame, "a", "y") == pytest.approx(0.0)


def test_what_does_not_vary_has_no_sensitivity() -> None:
    frame = pd.DataFrame({"a": [1, 2], "y": [5e9, 5e9]})
    assert sensitivity(frame, "a", "y") is None


def test_many_values_are_binned_evenly() -> None:
    bins = binned(pd.Series(range(80)), most=8)
    assert bins.value_counts().tolist() == [10] * 8
