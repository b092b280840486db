# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A mirror wall in relief that shows the tree behind the camera, its leaves placed at random."""

from __future__ import annotations

from random import Random

from recipes.glb import GlbWriter
from recipes.mesh import Mesh, ellipsoid, grid, joined, lathe, quad
from recipes.tree import Branch, Level, bark, grow, leaf, random_rotation
from recipes.vec import Quat, Vec3, add, cos_sin, cosine, spline

TRIANGLES = 410000

COLUMNS, ROWS, TILE = 14, 10, 1.6
TREE: Vec3 = (0.0, 0.0, 15.0)
LEVELS = [
    Level(children=14, segments=9, sides=8, spread=0.17, reach=0.55, wiggle=0.22, lift=0.06),
    Level(children=7, segments=6, sides=5, spread=0.14, reach=0.5, wiggle=0.25, lift=0.05),
    Level(children=5, segments=4, sides=4, spread=0.14, reach=0.5, wiggle=0.3, lift=0.0),
]
TRUNK: list[Vec3] = [
    (0.0, -0.1, 0.0),
    (0.15, 1.0, 0.1),
    (-0.2, 3.0, 0.0),
    (0.3, 5.5, 0.2),
    (0.0, 8.0, 0.0),
    (0.4, 11.0, -0.1),
]


def rosette() -> Mesh:
    """One tile's relief, facing +y: a shallow lens in a ring, and a stud on each corner."""
    corner = TILE * 0.5
    stud = ellipsoid((corner, 0.0, corner), (0.24, 0.2, 0.24), 12, 18)
    return joined([lens(), rim(), stud]).smoothed()


def rim() -> Mesh:
    """Half of a twisted rope laid in a ring."""
    rings = []
    for i in range(56):
        c, s = cos_sin(i / 56)
        section = []
        for k in range(7):
            out, up = cos_sin(k / 12)
            strand = 0.07 * (1.0 + 0.3 * cosine(k / 6 + i / 7))
            section.append((c * (0.7 + strand * out), 1.4 * strand * up, s * (0.7 + strand * out)))
        rings.append(section)
    return grid([*rings, rings[0]])


def lens() -> Mesh:
    """So flat that the tree stays large in it, so curved that each shows it a little shifted."""
    radius, rise = 0.64, 0.012
    shares = [k / 6.0 for k in range(6, 0, -1)]
    dome = [(radius * share, 0.02 + rise * (1.0 - share * share)) for share in shares]
    return lathe([*dome, (0.0, 0.02 + rise)], 40)


def wall(scene: GlbWriter) -> None:
    """A plain mirror with a relief of rosettes before it, one node for all of them."""
    plate = scene.material("plate", (0.8, 0.78, 0.72), 0.9)
    silver = scene.material("silver", (0.92, 0.92, 0.94), 0.95)
    half = COLUMNS * TILE * 0.5
    height = ROWS * TILE
    back = quad((-half, 0.0, 0.0), (half, 0.0, 0.0), (half, height, 0.0), (-half, height, 0.0))
    scene.place(scene.mesh("plate", [(back, plate)]), "plate")
    tile = scene.mesh("rosette", [(rosette(), silver)], quantized=False)
    centres = [
        ((i + 0.5) * TILE - half, (j + 0.5) * TILE, 0.0)
        for j in range(ROWS)
        for i in range(COLUMNS)
    ]
    c, s = cos_sin(0.125)
    upright: Quat = (s, 0.0, 0.0, c)
    scene.place_many(tile, "relief", centres, [upright] * len(centres))


def crown(count: int, rng: Random) -> list[Vec3]:
    """Leaves at random places of a few round clouds."""
    clouds = []
    for k in range(16):
        c, s = cos_sin(k * 0.3819660112501051)
        level = k / 15.0
        out = 3.4 * (1.0 - level) + 0.8
        size = 2.5 - 0.9 * level
        clouds.append((add(TREE, (c * out, 5.4 + 6.6 * level, s * out)), size))
    places: list[Vec3] = []
    while len(places) < count:
        centre, size = clouds[len(places) % len(clouds)]
        v = (rng.random() * 2.0 - 1.0, rng.random() * 2.0 - 1.0, rng.random() * 2.0 - 1.0)
        if v[0] * v[0] + v[1] * v[1] + v[2] * v[2] <= 1.0:
            places.append(add(centre, (v[0] * size, v[1] * size * 0.8, v[2] * size)))
    return places


def tree(scene: GlbWriter, rng: Random) -> None:
    """Trunk and branches, then as many leaves as the scene has triangles left."""
    wood = scene.material("bark", (0.5, 0.36, 0.25))
    path = spline(TRUNK, 21)
    radii = [0.6 * (1.0 - 0.9 * i / 20) + 0.5 / (1.0 + i * i) for i in range(20)]
    orders = grow(Branch([add(TREE, p) for p in path], [*radii, 0.0]), LEVELS, rng)
    branches = bark(orders, [16] + [level.sides for level in LEVELS]).smoothed()
    scene.place(scene.mesh("branches", [(branches, wood)]), "branches")

    colours: list[Vec3] = [(0.3, 0.65, 0.15), (0.5, 0.75, 0.2), (0.8, 0.6, 0.15)]
    greens = [scene.material(f"leaf {i}", c, double_sided=True) for i, c in enumerate(colours)]
    shape = leaf(0.26, 0.6)
    kinds = [scene.mesh(f"leaf {i}", [(shape, g)], quantized=False) for i, g in enumerate(greens)]
    places = crown((TRIANGLES - scene.triangles) // len(shape.triangles), rng)
    for i, kind in enumerate(kinds):
        mine = places[i :: len(kinds)]
        scene.place_many(kind, f"leaves {i}", mine, [random_rotation(rng) for _ in mine])


def build() -> GlbWriter:
    scene = GlbWriter("oldtree")
    wall(scene)
    ground = scene.material("ground", (0.5, 0.45, 0.35))
    plane = quad((-30.0, 0.0, 26.0), (30.0, 0.0, 26.0), (30.0, 0.0, -4.0), (-30.0, 0.0, -4.0))
    scene.place(scene.mesh("ground", [(plane, ground)]), "ground")
    haze = scene.material("haze", (0.55, 0.7, 0.95), 0.1)
    far = quad((30.0, 0.0, 26.0), (-30.0, 0.0, 26.0), (-30.0, 24.0, 26.0), (30.0, 24.0, 26.0))
    scene.place(scene.mesh("haze", [(far, haze)]), "haze")
    tree(scene, Random(1957))
    scene.camera((1.6, 5.0, 9.0), (0.6, 6.0, 0.0), 0.85)
    scene.point_light((-6.0, 19.0, 6.0), (1.0, 0.95, 0.88), 1700.0)
    return scene
