# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A fairy on a mushroom: a small detailed model in a large simple open place.

Behind her stand three transparent layers, one after the other, and a plain sky.
"""

from __future__ import annotations

from random import Random

from recipes import fairy_figure as figure
from recipes.glb import GlbWriter
from recipes.mesh import Mesh, cone, ellipsoid, grid, joined, skin, sweep
from recipes.vec import (
    Y_AXIS,
    Vec3,
    cos_sin,
    cosine,
    noise,
    profile_at,
    quat_about,
    spline,
)

TRIANGLES = 173000
CAP_TOP = 1.62

# (radius, height) of the mushroom's cap: from the stem out along the gills, then over the top.
UNDER = [(0.16, 1.13), (0.4, 1.1), (0.7, 1.04), (0.95, 0.98), (1.08, 0.95)]
DOME = [
    (1.15, 0.97), (1.17, 1.03), (1.12, 1.14), (0.98, 1.29), (0.75, 1.45), (0.45, 1.57),
    (0.12, 1.62),
]  # fmt: skip


def cap(sides: int) -> Mesh:
    """A wavy dome with gills below it."""
    gills = sides // 4
    profile = [(r, y, 0.05) for r, y in spline_profile(UNDER, 6)]
    profile += [(r, y, 0.0) for r, y in spline_profile(DOME, 20)]
    rings = []
    for r, y, depth in profile:
        row = []
        for i in range(sides):
            turn = i / sides
            c, s = cos_sin(turn)
            wave = 1.0 + 0.025 * cosine(turn * 5.0) * r
            row.append((c * r * wave, y + depth * cosine(turn * gills), -s * r * wave))
        rings.append(row)
    return skin(rings, (0.0, profile[0][1], 0.0), (0.0, CAP_TOP, 0.0))


def spline_profile(points: list[tuple[float, float]], samples: int) -> list[tuple[float, float]]:
    return [(x, y) for x, y, _ in spline([(r, h, 0.0) for r, h in points], samples)]


def stem(sides: int) -> Mesh:
    """Thicker at the foot, fibrous, with a ragged ring."""
    girth = [0.3, 0.33, 0.25, 0.2, 0.18, 0.2, 0.36, 0.19, 0.18]
    rows = 40
    rings = []
    for j in range(rows):
        t = j / (rows - 1)
        row = []
        for i in range(sides):
            c, s = cos_sin(i / sides)
            r = profile_at(girth, t) * (1.0 + 0.03 * cosine(i / sides * 14.0 + t))
            row.append((c * r, -0.1 + 1.25 * t, -s * r))
        rings.append(row)
    return skin(rings, (0.0, -0.1, 0.0), (0.0, 1.15, 0.0))


def spots() -> Mesh:
    """Flat warts on the cap."""
    parts = []
    for k in range(26):
        c, s = cos_sin(k * 0.3819660112501051)
        share = (k + 1.5) / 28.0
        r, y, _ = spline([(r, y, 0.0) for r, y in reversed(DOME)], 101)[round(share * 85)]
        size = 0.05 + 0.05 * noise(k * 3.7, 0.5)
        parts.append(ellipsoid((c * r, y, -s * r), (size * 1.3, size * 0.6, size * 1.3), 9, 14))
    return joined(parts)


def mushrooms(scene: GlbWriter) -> None:
    """The one she stands on, and smaller ones that share a coarser mesh."""
    red = scene.material("cap", (0.85, 0.13, 0.08))
    pale = scene.material("stem", (0.88, 0.82, 0.7))
    warts = joined([stem(72), spots()])
    large = [(cap(240).smoothed(), red), (warts.smoothed(), pale)]
    scene.place(scene.mesh("mushroom", large), "mushroom")
    small = scene.mesh("small mushroom", [(cap(80).smoothed(), red), (stem(24).smoothed(), pale)])
    spots_: list[tuple[Vec3, float]] = [
        ((1.7, 0.0, 0.6), 0.45),
        ((2.2, 0.0, -0.5), 0.65),
        ((-1.6, 0.0, 0.9), 0.35),
        ((-2.1, 0.0, -0.3), 0.55),
    ]
    for i, (place, size) in enumerate(spots_):
        turn = quat_about(Y_AXIS, i * 0.23)
        scene.place(small, f"small mushroom {i}", place, turn, (size, size, size))


def grass(scene: GlbWriter, rng: Random) -> None:
    """One tuft, instanced."""
    blades = []
    for k in range(14):
        c, s = cos_sin(k * 0.3819660112501051)
        lean = 0.05 + 0.03 * k
        height = 0.5 + 0.3 * rng.random()
        root: Vec3 = (c * 0.05, -0.02, s * 0.05)
        middle: Vec3 = (c * (0.05 + lean * 0.4), height * 0.65, s * (0.05 + lean * 0.4))
        tip: Vec3 = (c * (0.05 + lean), height, s * (0.05 + lean))
        blades.append(sweep(spline([root, middle, tip], 5), [0.018, 0.016, 0.012, 0.008, 0.0], 3))
    green = scene.material("grass", (0.3, 0.62, 0.18))
    tuft = scene.mesh("grass", [(joined(blades).smoothed(), green)], quantized=False)
    places, turns, sizes = [], [], []
    for _ in range(36):
        c, s = cos_sin(rng.random())
        out = 0.5 + 3.2 * rng.random()
        places.append((c * out, 0.0, s * out))
        turns.append(quat_about(Y_AXIS, rng.random()))
        size = 0.5 + 0.6 * rng.random()
        sizes.append((size, size, size))
    scene.place_many(tuft, "grass", places, turns, sizes)


def fairy(scene: GlbWriter, rng: Random) -> None:
    """The figure; her hair takes what triangles are left."""
    skin_ = scene.material("skin", (0.92, 0.68, 0.55))
    dress = scene.material("dress", (0.3, 0.68, 0.35))
    wings = scene.material("wings", (0.6, 0.78, 0.95))
    gold = scene.material("gold", (0.95, 0.75, 0.3))
    dark = scene.material("eyes", (0.1, 0.2, 0.35))
    hair = scene.material("hair", (0.75, 0.38, 0.12))
    torso = figure.trunk(1.0, 0.0, 1.0, 40, 48)
    bare = joined([torso, figure.arms(), figure.legs(), figure.head()])
    clothes = joined([figure.trunk(1.07, 0.3, 0.74, 30, 64), figure.skirt(), figure.shoes()])
    jewels = joined([figure.wand(), figure.wreath(), figure.sash()])
    parts = [
        (bare.smoothed(), skin_),
        (clothes.smoothed(), dress),
        (figure.wings().smoothed(), wings),
        (jewels.smoothed(), gold),
        (figure.eyes().smoothed(), dark),
    ]
    feet: Vec3 = (0.0, CAP_TOP, 0.0)
    turn = quat_about(Y_AXIS, 0.06)
    scene.place(scene.mesh("fairy", parts), "fairy", feet, turn)
    strands = (TRIANGLES - scene.triangles) // figure.TRIANGLES_PER_STRAND
    locks = figure.hair(strands, rng).smoothed()
    scene.place(scene.mesh("hair", [(locks, hair)]), "hair", feet, turn)


def hill(x: float, z: float) -> float:
    """The ground: flat about the mushroom, rolling farther out."""
    far = min(1.0, (x * x + z * z) / 150.0)
    return far * 1.6 * (noise(x * 0.16 + 7.0, z * 0.16) - 0.4)


def place_large(scene: GlbWriter) -> None:
    """Ground, a few firs, three transparent layers and the sky."""
    moss = scene.material("moss", (0.32, 0.45, 0.2))
    steps = 24
    rows = []
    for j in range(steps + 1):
        z = 20.0 - 40.0 * j / steps
        xs = [40.0 * i / steps - 20.0 for i in range(steps + 1)]
        rows.append([(x, hill(x, z), z) for x in xs])
    scene.place(scene.mesh("ground", [(grid(rows).smoothed(), moss)]), "ground")

    firs(scene)
    tints: list[Vec3] = [(0.75, 0.95, 0.85), (0.8, 0.9, 1.0), (0.95, 0.85, 1.0)]
    for k, tint in enumerate(tints):
        glass = scene.material(
            f"layer {k}", tint, 0.1, transmission=0.9, ior=1.05, double_sided=True
        )
        scene.place(scene.mesh(f"layer {k}", [(layer(k), glass)]), f"layer {k}")
    blue = scene.material("sky", (0.6, 0.75, 0.95), 0.1)
    scene.place(scene.mesh("sky", [(arc_wall(19.0, [15.0] * 25, 0.22), blue)]), "sky")


def firs(scene: GlbWriter) -> None:
    """Plain cones, some before and some between the layers."""
    bark = scene.material("bark", (0.4, 0.3, 0.24))
    needles = scene.material("needles", (0.2, 0.42, 0.25))
    trunk = sweep([(0.0, -1.0, 0.0), (0.0, 1.5, 0.0)], [0.22, 0.18], 8)
    tiers = [cone((0.0, 1.0 + i, 0.0), (0.0, 3.2 + i, 0.0), 1.5 - 0.35 * i, 12) for i in range(3)]
    fir = scene.mesh("fir", [(trunk, bark), (joined(tiers), needles)])
    spots: list[tuple[float, float, float]] = [
        (-6.5, -3.5, 1.0), (6.2, -4.2, 0.85), (8.6, -1.5, 1.1), (-4.2, -8.6, 1.0),
        (2.6, -9.4, 1.15),
        (-9.5, -8.5, 1.2), (9.5, -9.0, 1.2), (-1.2, -12.6, 1.2), (6.4, -12.4, 1.3),
        (-8.2, -12.8, 1.4),
    ]  # fmt: skip
    for i, (x, z, size) in enumerate(spots):
        turn = quat_about(Y_AXIS, i * 0.07)
        scene.place(fir, f"fir {i}", (x, hill(x, z), z), turn, (size, size, size))


def layer(k: int) -> Mesh:
    """A curved pane with the outline of hills, higher the farther away it stands."""
    heights = [2.8 + 1.3 * k + 3.0 * noise(i * 0.31 + 11.0 * k, 3.5 * k) for i in range(33)]
    return arc_wall(8.0 + 3.2 * k, heights, 0.2)


def arc_wall(radius: float, heights: list[float], half_turn: float) -> Mesh:
    """Upright, behind the origin and facing it."""
    low, high = [], []
    last = len(heights) - 1
    for i, height in enumerate(heights):
        c, s = cos_sin(0.75 + half_turn * (2.0 * i / last - 1.0))
        low.append((c * radius, -1.0, s * radius))
        high.append((c * radius, height, s * radius))
    return grid([low, high]).smoothed()


def build() -> GlbWriter:
    rng = Random(53)
    scene = GlbWriter("fairy")
    place_large(scene)
    mushrooms(scene)
    grass(scene, rng)
    fairy(scene, rng)
    scene.camera((1.2, 3.4, 11.0), (0.0, 2.7, 0.0), 0.62)
    scene.point_light((4.0, 14.0, 6.0), (1.0, 0.95, 0.86), 1700.0)
    return scene
