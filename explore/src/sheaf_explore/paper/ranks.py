# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Rank correlation of two orders in which ties are ties."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd


def spearman(a: pd.Series, b: pd.Series) -> float:
    """Spearman's rho: Pearson's correlation of ranks, equal values sharing their mean rank.

    Not a number if one of them does not vary.
    """
    ranks = (a.rank(method="average"), b.rank(method="average"))
    x, y = (series.to_numpy(dtype=float) - series.mean() for series in ranks)
    scale = math.sqrt(float(x @ x) * float(y @ y))
    return float(x @ y) / scale if scale > 0 else math.nan


def kendall(a: pd.Series, b: pd.Series) -> float:
    """Kendall's tau-b (Kendall 1945): agreeing less disagreeing pairs, corrected for ties.

    Not a number if one of them does not vary.
    """
    i, j = np.triu_indices(len(a), k=1)
    x, y = (s.to_numpy(dtype=float) for s in (a, b))
    dx, dy = np.sign(x[i] - x[j]), np.sign(y[i] - y[j])
    scale = math.sqrt(float(np.abs(dx).sum()) * float(np.abs(dy).sum()))
    return float(dx @ dy) / scale if scale > 0 else math.nan
