# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The fairy: a figure a little over two units tall, feet at the origin, looking along +z."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from recipes.mesh import Mesh, cone, ellipsoid, frames, joined, ring, sheet, skin, sweep
from recipes.tree import random_direction
from recipes.vec import (
    Y_AXIS,
    Z_AXIS,
    Vec3,
    add,
    along,
    cos_sin,
    cosine,
    cross,
    mix,
    mul,
    profile_at,
    sine,
    smoothstep,
    spline,
    spline_at,
    unit,
)

HEAD: Vec3 = (0.0, 2.06, 0.02)
SKULL: Vec3 = (0.15, 0.185, 0.165)

HAIR_RINGS, HAIR_SIDES = 11, 3
TRIANGLES_PER_STRAND = (HAIR_RINGS - 1) * HAIR_SIDES * 2


def stack(
    heights: list[float], sides: int, place: Callable[[int, float], tuple[float, float]]
) -> list[list[Vec3]]:
    """Level rings about the y axis; `place` gives (x, z) for a ring and a turn."""
    return [
        [(x, y, z) for x, z in (place(j, i / sides) for i in range(sides))]
        for j, y in enumerate(heights)
    ]


def trunk(girth: float, low: float, high: float, rows: int, sides: int) -> Mesh:
    """Hips, waist, chest and neck between two shares of the way up, `girth` times as wide."""
    wide = [0.13, 0.17, 0.155, 0.11, 0.14, 0.175, 0.165, 0.06, 0.05]
    deep = [0.1, 0.125, 0.11, 0.085, 0.115, 0.12, 0.085, 0.055, 0.05]
    shares = [low + (high - low) * j / (rows - 1) for j in range(rows)]

    def place(j: int, turn: float) -> tuple[float, float]:
        c, s = cos_sin(turn)
        t = shares[j]
        return (c * profile_at(wide, t) * girth, -s * profile_at(deep, t) * girth)

    heights = [0.98 + 0.94 * t for t in shares]
    rings = stack(heights, sides, place)
    return skin(rings, (0.0, heights[0], 0.0), (0.0, heights[-1], 0.0))


def limb(points: list[Vec3], girth: list[float], rows: int, sides: int) -> Mesh:
    radii = [profile_at(girth, i / (rows - 1)) for i in range(rows)]
    return sweep(spline(points, rows), radii, sides)


def hand(wrist: Vec3, forward: Vec3, across: Vec3) -> Mesh:
    """A palm and five fingers, spread along `across`."""
    palm_end = along(wrist, forward, 0.09)
    parts = [limb([wrist, along(wrist, forward, 0.05), palm_end], [0.026, 0.04, 0.03], 8, 14)]
    for k in range(5):
        spread = (k - 2) * 0.5
        root = along(along(wrist, forward, 0.075 - 0.03 * (k == 0)), across, spread * 0.034)
        heading = unit(along(forward, across, spread * (0.5 if k else 0.9)))
        reach = (0.06, 0.085, 0.095, 0.09, 0.07)[k]
        path = spline([root, along(root, heading, reach * 0.6), along(root, heading, reach)], 8)
        parts.append(sweep(path, [0.012, 0.012, 0.0115, 0.011, 0.011, 0.01, 0.009, 0.005], 8))
    return joined(parts)


def arms() -> Mesh:
    """One raised with the wand, one held out."""
    raised: list[Vec3] = [
        (0.15, 1.7, 0.0), (0.23, 1.68, 0.02), (0.46, 1.62, 0.16), (0.62, 1.92, 0.3),
    ]  # fmt: skip
    held: list[Vec3] = [
        (-0.15, 1.7, 0.0), (-0.23, 1.67, 0.0), (-0.44, 1.44, 0.06), (-0.74, 1.4, 0.26),
    ]  # fmt: skip
    girth = [0.05, 0.06, 0.043, 0.027]
    return joined(
        [
            limb(raised, girth, 40, 24),
            limb(held, girth, 40, 24),
            hand(raised[-1], unit((0.3, 1.0, 0.3)), unit((-0.8, 0.3, 0.4))),
            hand(held[-1], unit((-1.0, 0.05, 0.5)), unit((0.4, 0.1, 0.9))),
        ]
    )


def legs() -> Mesh:
    """One carries her, the other is bent at the knee."""
    girth = [0.095, 0.1, 0.085, 0.058, 0.062, 0.045, 0.032]
    straight: list[Vec3] = [
        (0.07, 1.08, 0.0), (0.085, 0.95, 0.01), (0.085, 0.74, 0.03), (0.08, 0.55, 0.05),
        (0.075, 0.4, 0.02), (0.07, 0.22, 0.0), (0.07, 0.08, 0.0),
    ]  # fmt: skip
    bent: list[Vec3] = [
        (-0.07, 1.08, 0.0), (-0.1, 0.96, 0.06), (-0.14, 0.8, 0.16), (-0.17, 0.66, 0.25),
        (-0.17, 0.52, 0.16), (-0.17, 0.4, 0.02), (-0.17, 0.28, -0.12),
    ]  # fmt: skip
    return joined([limb(straight, girth, 48, 24), limb(bent, girth, 48, 24)])


def shoes() -> Mesh:
    """Pointed, with curled toes."""
    girth = [0.03, 0.045, 0.042, 0.04, 0.028, 0.012]
    flat: list[Vec3] = [
        (0.07, 0.13, -0.01), (0.07, 0.05, -0.02), (0.07, 0.045, 0.06),
        (0.075, 0.045, 0.16), (0.08, 0.06, 0.25), (0.08, 0.12, 0.29),
    ]  # fmt: skip
    swung: list[Vec3] = [
        (-0.17, 0.32, -0.09), (-0.17, 0.24, -0.15), (-0.17, 0.18, -0.11),
        (-0.17, 0.1, -0.05), (-0.17, 0.03, 0.01), (-0.17, 0.02, 0.07),
    ]  # fmt: skip
    return joined([limb(flat, girth, 30, 18), limb(swung, girth, 30, 18)])


def head() -> Mesh:
    """Skull with cheeks and chin, nose, lips and pointed ears."""
    parts = [ellipsoid(HEAD, SKULL, 40, 48).moved(_face)]
    x, y, z = HEAD
    bridge = [(0.03, 0.15), (-0.01, 0.185), (-0.035, 0.185), (-0.045, 0.155)]
    nose: list[Vec3] = [(x, y + up, z + ahead) for up, ahead in bridge]
    parts.append(limb(nose, [0.012, 0.018, 0.022, 0.014], 14, 14))
    for lift, reach in ((-0.088, 0.034), (-0.102, 0.03)):
        parts.append(ellipsoid((x, y + lift, z + 0.138), (reach, 0.009, 0.016), 10, 16))
    for side in (-1.0, 1.0):
        lobe = [(0.13, -0.03, -0.01), (0.175, 0.01, -0.02), (0.24, 0.09, -0.05)]
        ear: list[Vec3] = [(side * out, y + up, z + ahead) for out, up, ahead in lobe]
        parts.append(sweep(spline(ear, 12), [0.035 - 0.003 * i for i in range(11)] + [0.0], 16))
    return joined(parts)


def _face(p: Vec3) -> Vec3:
    """Draw the lower half of the skull in to a chin."""
    down = smoothstep(0.0, -0.185, p[1] - HEAD[1])
    ahead = smoothstep(-0.1, 0.16, p[2])
    behind = 1.0 - ahead
    return (p[0] * (1.0 - 0.42 * down), p[1] - 0.025 * down * ahead, p[2] - 0.02 * down * behind)


def eyes() -> Mesh:
    x, y, z = HEAD
    return joined(
        ellipsoid((x + side * 0.057, y + 0.02, z + 0.14), (0.028, 0.034, 0.018), 12, 18)
        for side in (-1.0, 1.0)
    )


def skirt() -> Mesh:
    """Pleats that widen towards a hem of petals; inside and outside are one closed surface."""
    rows, sides = 40, 192
    flare = [0.125, 0.2, 0.29, 0.36, 0.42, 0.5]
    order = list(range(rows)) + list(range(rows - 1, -1, -1))

    def point(j: int, inside: bool, turn: float) -> Vec3:
        t = j / (rows - 1)
        c, s = cos_sin(turn)
        pleat = 0.075 * t * cosine(turn * 16.0) + 0.03 * t * t * cosine(turn * 5.0)
        radius = profile_at(flare, t) + pleat - (0.012 if inside else 0.0)
        drop = 0.66 * t + 0.07 * t * t * cosine(turn * 8.0)
        return (c * radius, 1.31 - drop, -s * radius * 0.9)

    rings = []
    for k, j in enumerate(order):
        rings.append([point(j, k < rows, i / sides) for i in range(sides)])
    return skin(rings, looped=True)


def wing(root: Vec3, tip: Vec3, width: float, droop: float) -> Mesh:
    """The right one of a pair: a thin leaf with a relief of veins."""
    rows = []
    across = unit((0.35, -1.0, droop))
    for j in range(44):
        u = j / 43.0
        middle = add(mix(root, tip, u), (0.0, 0.0, -0.35 * u * (1.0 - u)))
        half = width * (0.06 + 1.5 * u * (1.0 - u) * (0.55 + 0.9 * u))
        half *= 1.0 + 0.03 * cosine(u * 11.0)
        row = []
        for i in range(27):
            v = (i - 13) / 13.0
            vein = 0.012 * cosine(v * 3.5 + u * u * 2.0) * cosine(u * 9.0)
            bow = -0.12 * v * v * half
            row.append(along(along(middle, across, v * half), Z_AXIS, vein + bow))
        rows.append(row)
    return sheet(rows, 0.008)


def wings() -> Mesh:
    right = joined(
        [
            wing((0.05, 1.62, -0.12), (1.25, 2.75, -0.45), 0.46, 0.1),
            wing((0.05, 1.5, -0.12), (1.0, 0.95, -0.4), 0.34, 0.1),
        ]
    )
    left = right.moved(lambda p: (-p[0], p[1], p[2])).flipped()
    return joined([right, left])


def wand() -> Mesh:
    """A twisted rod with a star on its tip."""
    foot: Vec3 = (0.68, 1.9, 0.42)
    tip: Vec3 = (0.66, 2.5, 0.5)
    path = spline([foot, mix(foot, tip, 0.5), tip], 30)
    rings = []
    for j, frame in enumerate(frames(path)):

        def radius(turn: float, twist: float = j * 0.06) -> float:
            return 0.012 + 0.003 * cosine(turn * 3.0 + twist)

        rings.append(ring(path[j], frame, 12, radius))
    rays = [skin(rings, path[0], path[-1]), ellipsoid(tip, (0.05, 0.05, 0.05), 12, 18)]
    for k in range(8):
        c, s = cos_sin(k / 8)
        rays.append(cone(tip, add(tip, (0.13 * c, 0.13 * s, 0.0)), 0.025, 10))
    return joined(rays)


def hair(strands: int, rng: Random) -> Mesh:
    """Long wavy strands from the top and the back of the skull."""
    parts: list[Mesh] = []
    while len(parts) < strands:
        d = random_direction(rng)
        below = d[1] < -0.15
        on_face = d[2] > 0.55 + 0.2 * d[1] or (d[2] > 0.3 and d[1] < 0.62)
        if not below and not on_face:
            parts.append(strand(d, rng))
    return joined(parts)


def strand(d: Vec3, rng: Random) -> Mesh:
    """One strand: out of the skull, over the shoulder and down the back."""
    root = add(HEAD, (d[0] * SKULL[0], d[1] * SKULL[1], d[2] * SKULL[2]))
    sway = (rng.random() - 0.5) * 0.16
    reach = 0.55 + 0.4 * rng.random()
    out = unit((d[0], 0.0, d[2] - 0.75))
    shoulder = add(HEAD, (out[0] * 0.22, -0.2, out[2] * 0.2))
    crown = along(root, unit((d[0], d[1] + 0.3, d[2] - 0.3)), 0.05)
    middle = add(shoulder, (out[0] * 0.12 + sway, -0.45 * reach, -0.1))
    end = add(middle, (out[0] * 0.1 - sway, -0.5 * reach, 0.02 + 0.12 * (rng.random() - 0.5)))
    points = [root, crown, shoulder, middle, end]
    phase, curl = rng.random(), 0.022 + 0.02 * rng.random()
    path = []
    for i in range(HAIR_RINGS):
        t = i / (HAIR_RINGS - 1)
        c, s = cos_sin(phase + 1.6 * t)
        path.append(add(spline_at(points, t), mul((c, 0.0, s), curl * t)))
    radii = [0.0085 * (1.0 - 0.5 * i / (HAIR_RINGS - 1)) for i in range(HAIR_RINGS - 1)]
    return sweep(path, [*radii, 0.0], HAIR_SIDES)


def wreath() -> Mesh:
    """Flowers around the head."""
    parts = []
    for k in range(11):
        c, s = cos_sin(k / 11)
        middle = add(HEAD, (c * 0.15, 0.115 - 0.02 * s, s * 0.165))
        parts.append(ellipsoid(middle, (0.02, 0.02, 0.02), 8, 10))
        for i in range(5):
            pc, ps = cos_sin(i / 5)
            petal = add(middle, (-s * pc * 0.033, ps * 0.033, c * pc * 0.033))
            parts.append(ellipsoid(petal, (0.022, 0.022, 0.022), 6, 8))
    return joined(parts)


def sash() -> Mesh:
    """A wavy belt that hides where the skirt begins."""
    circle = [cos_sin(i / 64) for i in range(64)]
    path = [(c * 0.13, 1.315 + 0.01 * sine(i / 8), -s * 0.105) for i, (c, s) in enumerate(circle)]
    rings = []
    for here, there in zip(path, path[1:] + path[:1], strict=True):
        forward = unit((there[0] - here[0], 0.0, there[2] - here[2]))
        rings.append(ring(here, (Y_AXIS, cross(forward, Y_AXIS), forward), 12, lambda _: 0.024))
    return skin(rings, looped=True)
