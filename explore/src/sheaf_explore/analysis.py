# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""What a sweep's table says: Pareto fronts, and how much each axis matters."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pandas as pd


def pareto_front(values: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    """Which rows no other row beats: at most as large in every column and smaller in one.

    `values` is (points, objectives), all to be minimized; rows with a number missing are never on
    the front. Equal rows are all on it. Returns (points,) of truth values.
    """
    front: npt.NDArray[np.bool_] = np.logical_not(np.isnan(values).any(axis=1))
    for i in np.flatnonzero(front):
        others = values[front]
        beaten = (others <= values[i]).all(axis=1) & (others < values[i]).any(axis=1)
        front[i] = not beaten.any()
    return front


def sensitivity(frame: pd.DataFrame, axis: str, measure: str) -> float | None:
    """The share of a measure's variance that the axis explains alone.

    The first-order index of Sobol (1993), Var(E[y | x]) / Var(y), with the points of each value of
    the axis as the sample of E[y | x]. A full product has exactly this share; for a sample it is an
    estimate, biased upwards by values with few points. None if the measure does not vary.
    """
    known = frame[[axis, measure]].dropna()
    y = known[measure].astype(float)
    variance = float(y.var(ddof=0)) if len(y) else 0.0
    # A spread that rounding explains is none.
    if not variance > 1e-24 * float((y**2).mean() if len(y) else 0.0):
        return None
    means = y.groupby(known[axis]).transform("mean")
    return float(means.var(ddof=0)) / variance


def binned(values: pd.Series[Any], most: int = 8) -> pd.Series[Any]:
    """The series itself, or if it has many numeric values, the number of the equal-count bin."""
    if values.nunique() <= most or not pd.api.types.is_numeric_dtype(values.dtype):
        return values
    ranks = values.astype(float).rank(method="average", pct=True)
    return (ranks * most).map(math.ceil)
