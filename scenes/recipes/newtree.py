# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A tree of many branches and few leaves on a ground plane."""

from __future__ import annotations

from random import Random

from recipes.glb import GlbWriter
from recipes.mesh import quad
from recipes.tree import Branch, Level, bark, grow, leaf, random_rotation
from recipes.vec import Vec3, spline

TRIANGLES = 56000

TRUNK: list[Vec3] = [
    (0.0, -0.1, 0.0),
    (0.1, 0.6, 0.0),
    (-0.15, 2.0, 0.1),
    (0.2, 3.6, -0.1),
    (0.0, 5.4, 0.1),
    (0.3, 7.4, 0.0),
    (0.2, 9.2, 0.2),
]
LEVELS = [
    Level(children=13, segments=14, sides=10, spread=0.17, reach=0.56, wiggle=0.2, lift=0.07),
    Level(children=7, segments=9, sides=6, spread=0.14, reach=0.5, wiggle=0.25, lift=0.06),
    Level(children=5, segments=5, sides=4, spread=0.13, reach=0.5, wiggle=0.3, lift=0.04),
    Level(children=2, segments=4, sides=3, spread=0.12, reach=0.55, wiggle=0.3, lift=0.0),
]


def trunk() -> Branch:
    """Flared at the root."""
    path = spline(TRUNK, 25)
    radii = [0.42 * (1.0 - 0.9 * i / 24) + 0.3 / (1.0 + 1.5 * i * i) for i in range(24)]
    return Branch(path, [*radii, 0.0])


def build() -> GlbWriter:
    rng = Random(2007)
    scene = GlbWriter("newtree")
    ground = scene.material("ground", (0.55, 0.5, 0.4))
    wood = scene.material("bark", (0.62, 0.46, 0.32))
    green = scene.material("leaf", (0.35, 0.75, 0.2), double_sided=True)

    plane = quad((-20.0, 0.0, 20.0), (20.0, 0.0, 20.0), (20.0, 0.0, -20.0), (-20.0, 0.0, -20.0))
    scene.place(scene.mesh("ground", [(plane, ground)]), "ground")
    orders = grow(trunk(), LEVELS, rng)
    branches = bark(orders, [16] + [level.sides for level in LEVELS]).smoothed()
    scene.place(scene.mesh("branches", [(branches, wood)]), "branches")

    leaf_mesh = scene.mesh("leaf", [(leaf(0.3, 0.55), green)], quantized=False)
    count = (TRIANGLES - scene.triangles) // leaf_mesh.triangles
    twigs = orders[-1]
    tips = [twigs[i * len(twigs) // count].path[-1] for i in range(count)]
    sizes = [0.7 + 0.6 * rng.random() for _ in tips]
    scene.place_many(
        leaf_mesh,
        "leaves",
        tips,
        [random_rotation(rng) for _ in tips],
        [(size, size, size) for size in sizes],
    )
    scene.camera((3.0, 3.4, 17.5), (0.35, 5.75, 0.0), 0.68)
    scene.point_light((7.0, 13.0, 11.0), (1.0, 0.97, 0.9), 1900.0)
    return scene
