# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Branching for both trees, and the leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import floor, sqrt
from random import Random

from recipes.mesh import Mesh, joined, path_length, sweep
from recipes.vec import (
    Y_AXIS,
    Quat,
    Vec3,
    add,
    along,
    dot,
    mul,
    perpendicular,
    rotate_about,
    sub,
    unit,
)

# Successive branches turn by this much around their parent, so that none hides the one above.
GOLDEN_TURN = 0.3819660112501051
# Thinner twigs would lose their roundness to the quantization.
THINNEST = 0.006


@dataclass(frozen=True)
class Branch:
    path: list[Vec3]
    radii: list[float]


@dataclass(frozen=True)
class Level:
    """How branches of one order grow out of those of the order before."""

    children: int  # on each parent
    segments: int
    sides: int
    spread: float  # turns away from the parent
    reach: float  # length as a share of the parent's
    wiggle: float
    lift: float  # how much it bends towards the light


def random_direction(rng: Random) -> Vec3:
    """Evenly over the sphere, by rejection. Of Random only random() promises stable values."""
    while True:
        v = (rng.random() * 2.0 - 1.0, rng.random() * 2.0 - 1.0, rng.random() * 2.0 - 1.0)
        square = dot(v, v)
        if 0.01 < square <= 1.0:
            return mul(v, 1.0 / sqrt(square))


def random_rotation(rng: Random) -> Quat:
    """Evenly over all rotations, by rejection in four dimensions."""
    while True:
        q = [rng.random() * 2.0 - 1.0 for _ in range(4)]
        square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
        if 0.01 < square <= 1.0:
            size = sqrt(square)
            return (q[0] / size, q[1] / size, q[2] / size, q[3] / size)


def grow(trunk: Branch, levels: Sequence[Level], rng: Random) -> list[list[Branch]]:
    """All branches, in one list for each order; the trunk is order 0."""
    orders = [[trunk]]
    for level in levels:
        orders.append([b for parent in orders[-1] for b in _children(parent, level, rng)])
    return orders


def _children(parent: Branch, level: Level, rng: Random) -> list[Branch]:
    size = path_length(parent.path)
    start = rng.random()
    children = []
    for k in range(level.children):
        # Stratified along the outer part of the parent; the last one carries on from its end.
        at = 0.32 + 0.66 * (k + rng.random() * 0.8) / level.children
        index = min(len(parent.path) - 2, floor(at * (len(parent.path) - 1)))
        forward = unit(sub(parent.path[index + 1], parent.path[index]))
        away = rotate_about(perpendicular(forward), forward, start + k * GOLDEN_TURN)
        spread = level.spread * (0.75 + 0.5 * rng.random())
        heading = rotate_about(forward, away, spread)
        reach = size * level.reach * (1.25 - 0.6 * at) * (0.8 + 0.4 * rng.random())
        girth = parent.radii[index] * 0.68
        children.append(_branch(parent.path[index], heading, reach, girth, level, rng))
    return children


def _branch(
    root: Vec3, heading: Vec3, reach: float, girth: float, level: Level, rng: Random
) -> Branch:
    path = [root]
    step = reach / level.segments
    for _ in range(level.segments):
        bend = add(mul(random_direction(rng), level.wiggle), mul(Y_AXIS, level.lift))
        heading = unit(add(heading, bend))
        path.append(along(path[-1], heading, step))
    taper = [1.0 - 0.88 * i / level.segments for i in range(level.segments)]
    radii = [max(THINNEST, girth * share) for share in taper]
    return Branch(path, [*radii, 0.0])


def bark(orders: Sequence[Sequence[Branch]], sides: Sequence[int]) -> Mesh:
    return joined(
        sweep(branch.path, branch.radii, count)
        for branches, count in zip(orders, sides, strict=True)
        for branch in branches
    )


def leaf(size: float, width: float) -> Mesh:
    """Four triangles around a raised middle, from the stalk at the origin along +x."""
    w = size * width * 0.5
    points = [(0.0, 0.0, 0.0), (0.45, 0.0, w / size), (1.0, 0.0, 0.0), (0.45, 0.0, -w / size)]
    rim = [mul(p, size) for p in points]
    middle: Vec3 = (0.48 * size, 0.14 * size, 0.0)
    return Mesh([*rim, middle], [(i, (i + 1) % 4, 4) for i in range(4)])
