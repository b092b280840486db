# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""An arcaded court in two storeys, open to the sky: large polygons and some curved elements."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from recipes.glb import GlbWriter
from recipes.mesh import Mesh, box, grid, joined, lathe, quad, skin
from recipes.png import Pixel, rgb_png
from recipes.vec import Y_AXIS, Vec3, cos_sin, noise, quat_about

BAY = 3.0
BAYS_LONG, BAYS_WIDE = 6, 3
HALF_LONG, HALF_WIDE = BAY * BAYS_LONG / 2, BAY * BAYS_WIDE / 2
# The walk behind the arcade is as deep as a bay is wide, so that its vaults are square.
OUTER_LONG, OUTER_WIDE = HALF_LONG + BAY, HALF_WIDE + BAY
WALL = 0.5
ARCH_STEPS = 18

Place = tuple[float, float, float]  # x, z, turns about y that make +z face the court


@dataclass(frozen=True)
class Storey:
    floor: float
    spring: float  # height of the arches' feet
    top: float
    opening: float  # the arches' radius


LOWER = Storey(0.0, 3.3, 5.2, 1.2)
UPPER = Storey(5.5, 8.0, 9.7, 1.2)

# (radius, height) of a column, the height as a share of the shaft's.
COLUMN = [
    (0.40, 0.0), (0.40, 0.04), (0.37, 0.045), (0.39, 0.06), (0.37, 0.075), (0.31, 0.08),
    (0.315, 0.2), (0.31, 0.4), (0.295, 0.6), (0.27, 0.8), (0.265, 0.855), (0.30, 0.86),
    (0.30, 0.875), (0.27, 0.88), (0.29, 0.91), (0.36, 0.95), (0.42, 0.96), (0.42, 1.0),
]  # fmt: skip
BALUSTER = [
    (0.09, 0.0), (0.09, 0.06), (0.05, 0.1), (0.055, 0.16), (0.1, 0.3), (0.095, 0.4),
    (0.05, 0.6), (0.04, 0.68), (0.07, 0.72), (0.08, 0.8),
]  # fmt: skip
URN = [
    (0.0, 0.0), (0.34, 0.0), (0.34, 0.08), (0.16, 0.14), (0.12, 0.24), (0.2, 0.32),
    (0.44, 0.52), (0.55, 0.78), (0.52, 0.95), (0.4, 1.05), (0.47, 1.14), (0.5, 1.16),
    (0.42, 1.16), (0.34, 1.06), (0.0, 0.9),
]  # fmt: skip


def arc(radius: float, steps: int = ARCH_STEPS) -> list[tuple[float, float]]:
    """A half circle about the origin, from right to left."""
    turns = [cos_sin(0.5 * i / steps) for i in range(steps + 1)]
    return [(c * radius, s * radius) for c, s in turns]


def column(height: float, girth: float, sides: int) -> Mesh:
    """Its ends are hidden by the floor and the block above, so they stay open."""
    return lathe([(r * girth, y * height) for r, y in COLUMN], sides).smoothed()


def spandrel(storey: Storey) -> Mesh:
    """Both faces of one bay of wall over an arch, which is centred on the origin."""
    half, deep = BAY / 2, WALL / 2
    top = storey.top - storey.spring
    edge = [(half, 0.0), *arc(storey.opening), (-half, 0.0)]
    faces = []
    for z in (deep, -deep):
        face = grid([[(x, y, z) for x, y in edge], [(x, top, z) for x, _ in edge]])
        faces.append(face.flipped() if z > 0.0 else face)
    return joined(faces)


def soffit(storey: Storey) -> Mesh:
    """The underside of an arch."""
    edge = arc(storey.opening)
    return grid([[(x, y, z) for x, y in edge] for z in (WALL / 2, -WALL / 2)]).smoothed()


def moulding(storey: Storey) -> Mesh:
    """A half-sunk round bar along the arch, on the side of the court."""
    section = [cos_sin(k / 5) for k in range(5)]
    radius = storey.opening + 0.12
    rings = [
        [(x * (radius + 0.1 * a), y * (radius + 0.1 * a), WALL / 2 - 0.1 * b) for a, b in section]
        for x, y in arc(1.0)
    ]
    return skin(rings, None, None).smoothed()


def vault(storey: Storey) -> Mesh:
    """A groin vault over one square of the walk, seen from below: four webs about the origin."""
    radius, rise = BAY / 2, storey.top - 0.15 - storey.spring
    webs = []
    for k in range(4):
        c, s = cos_sin(k / 4)
        rows = []
        for j in range(1, 6):
            out = j / 5.0
            row: list[Vec3] = []
            for side, _ in arc(out, 6):
                x, y, z = side * radius, sqrt(1.0 - side * side) * rise, out * radius
                row.append((c * x + s * z, y, c * z - s * x))
            rows.append(row)
        web = grid(rows)
        web.positions.append((0.0, rise, 0.0))
        crown = len(web.positions) - 1
        web.triangles += [(i + 1, i, crown) for i in range(len(rows[0]) - 1)]
        webs.append(web.flipped().smoothed())
    return joined(webs)


def around(inner: tuple[float, float], outer: tuple[float, float], low: float, high: float) -> Mesh:
    """Four boxes that make a rectangular ring about the y axis."""
    (a, b), (c, d) = inner, outer
    return joined(
        [
            box((-c, low, b), (c, high, d)),
            box((-c, low, -d), (c, high, -b)),
            box((-c, low, -b), (-a, high, b)),
            box((a, low, -b), (c, high, b)),
        ]
    )


def bays() -> list[Place]:
    """The middles of all bays of the arcade."""
    places: list[Place] = []
    for i in range(BAYS_LONG):
        x = (i + 0.5) * BAY - HALF_LONG
        places += [(x, -HALF_WIDE, 0.0), (x, HALF_WIDE, 0.5)]
    for i in range(BAYS_WIDE):
        z = (i + 0.5) * BAY - HALF_WIDE
        places += [(-HALF_LONG, z, 0.25), (HALF_LONG, z, -0.25)]
    return places


def supports() -> list[tuple[float, float]]:
    """Where columns stand: between the bays and at the corners."""
    spots = []
    for i in range(BAYS_LONG + 1):
        x = i * BAY - HALF_LONG
        spots += [(x, -HALF_WIDE), (x, HALF_WIDE)]
    for i in range(1, BAYS_WIDE):
        z = i * BAY - HALF_WIDE
        spots += [(-HALF_LONG, z), (HALF_LONG, z)]
    return spots


def walk_squares() -> list[tuple[float, float]]:
    """The middles of the squares behind the arcade, its corners included."""
    squares = []
    for i in range(-1, BAYS_LONG + 1):
        for j in range(-1, BAYS_WIDE + 1):
            if i in (-1, BAYS_LONG) or j in (-1, BAYS_WIDE):
                squares.append(((i + 0.5) * BAY - HALF_LONG, (j + 0.5) * BAY - HALF_WIDE))
    return squares


def flagstones() -> bytes:
    """Four stones in two tones, with joints and grain; repeats without a seam at its joints."""
    size, stone = 64, 32
    rows: list[list[Pixel]] = []
    for j in range(size):
        row: list[Pixel] = []
        for i in range(size):
            light = (i // stone + j // stone) % 2 == 0
            tone = 215.0 if light else 130.0
            if i % stone < 1 or j % stone < 1:
                tone = 70.0
            tone += 36.0 * noise(i * 0.21, j * 0.21) + 24.0 * noise(i * 0.9, j * 0.9) - 30.0
            row.append((round(tone), round(tone * 0.94), round(tone * 0.84)))
        rows.append(row)
    return rgb_png(rows)


def paving() -> Mesh:
    x, z = OUTER_LONG, OUTER_WIDE
    mesh = quad((-x, 0.0, z), (x, 0.0, z), (x, 0.0, -z), (-x, 0.0, -z))
    mesh.uvs = [(px / BAY, pz / BAY) for px, _, pz in mesh.positions]
    return mesh


def masonry() -> Mesh:
    """Everything with straight edges: walls, slabs, ledges, blocks over the columns."""
    court = (HALF_LONG - WALL / 2, HALF_WIDE - WALL / 2)
    ledge = (court[0] - 0.15, court[1] - 0.15)
    outer = (OUTER_LONG, OUTER_WIDE)
    beyond = (OUTER_LONG + WALL, OUTER_WIDE + WALL)
    parts = [
        around(outer, beyond, 0.0, UPPER.top),
        around(court, outer, LOWER.top, UPPER.floor),
        around(ledge, court, LOWER.top + 0.05, UPPER.floor - 0.05),
        around(court, outer, UPPER.top, UPPER.top + 0.3),
        around(ledge, court, UPPER.top + 0.1, UPPER.top + 0.3),
    ]
    for storey, half in ((LOWER, 0.36), (UPPER, 0.32)):
        for x, z in supports():
            low, high = storey.spring - 0.22, storey.spring
            parts.append(box((x - half, low, z - half), (x + half, high, z + half)))
    rail_in = (HALF_LONG - 0.11, HALF_WIDE - 0.11)
    rail_out = (HALF_LONG + 0.11, HALF_WIDE + 0.11)
    floor = UPPER.floor
    parts.append(around(rail_in, rail_out, floor, floor + 0.1))
    parts.append(around(rail_in, rail_out, floor + 0.9, floor + 1.0))
    return joined(parts)


def doors() -> Mesh:
    """A panelled door at each bay of the outer walls, on both storeys."""
    parts = []
    for storey in (LOWER, UPPER):
        for x, z, turns in bays():
            c, s = cos_sin(turns)
            ahead = (-s * BAY, -c * BAY)
            for wide, high, deep in ((0.75, 2.5, 0.08), (0.6, 2.3, 0.12), (0.5, 1.0, 0.16)):
                across = (abs(c) * wide + abs(s) * deep, abs(s) * wide + abs(c) * deep)
                px, pz = x + ahead[0], z + ahead[1]
                low = (px - across[0], storey.floor, pz - across[1])
                parts.append(box(low, (px + across[0], storey.floor + high, pz + across[1])))
    return joined(parts)


def roof() -> Mesh:
    """Four slopes that leave the court open."""
    low, high = UPPER.top + 0.3, UPPER.top + 1.6
    a, b = HALF_LONG - 0.9, HALF_WIDE - 0.9
    c, d = OUTER_LONG + 0.9, OUTER_WIDE + 0.9
    inner: list[Vec3] = [(-a, low, b), (a, low, b), (a, low, -b), (-a, low, -b)]
    outer: list[Vec3] = [(-c, high, d), (c, high, d), (c, high, -d), (-c, high, -d)]
    sides = range(4)
    slopes = [quad(outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4], inner[i]) for i in sides]
    return joined(slopes)


def arcade(scene: GlbWriter, stone: int, trim: int) -> None:
    """Columns, arches, vaults and balusters: one small mesh each, instanced."""
    for name, storey, girth, sides in (("lower", LOWER, 0.95, 18), ("upper", UPPER, 0.75, 12)):
        shaft = column(storey.spring - 0.22 - storey.floor, girth, sides)
        mesh = scene.mesh(f"{name} column", [(shaft, trim)], quantized=False)
        scene.place_many(mesh, f"{name} columns", [(x, storey.floor, z) for x, z in supports()])
        curved = [soffit(storey)] + ([moulding(storey)] if storey is LOWER else [])
        parts = [(spandrel(storey), stone), (joined(curved), trim)]
        mesh = scene.mesh(f"{name} arch", parts, quantized=False)
        spots: list[Vec3] = [(x, storey.spring, z) for x, z, _ in bays()]
        scene.place_many(
            mesh, f"{name} arches", spots, [quat_about(Y_AXIS, t) for _, _, t in bays()]
        )

    mesh = scene.mesh("vault", [(vault(LOWER), stone)], quantized=False)
    scene.place_many(mesh, "vaults", [(x, LOWER.spring, z) for x, z in walk_squares()])

    post = lathe(BALUSTER, 6).smoothed()
    mesh = scene.mesh("baluster", [(post, trim)], quantized=False)
    spots = []
    for x, z, turns in bays():
        c, s = cos_sin(turns)
        for k in (-1.5, -0.5, 0.5, 1.5):
            spots.append((x + c * k * 0.6, UPPER.floor + 0.1, z - s * k * 0.6))
    scene.place_many(mesh, "balusters", spots)


def build() -> GlbWriter:
    scene = GlbWriter("sponza")
    flags = scene.material("flagstones", (0.9, 0.9, 0.9), texture=flagstones())
    stone = scene.material("stone", (0.78, 0.7, 0.58))
    trim = scene.material("trim", (0.88, 0.82, 0.72))
    wood = scene.material("wood", (0.5, 0.28, 0.15))
    tiles = scene.material("tiles", (0.7, 0.32, 0.2), double_sided=True)
    bronze = scene.material("bronze", (0.75, 0.55, 0.3))

    scene.place(scene.mesh("paving", [(paving(), flags)]), "paving")
    scene.place(scene.mesh("masonry", [(masonry(), stone)]), "masonry")
    scene.place(scene.mesh("doors", [(doors(), wood)]), "doors")
    scene.place(scene.mesh("roof", [(roof(), tiles)]), "roof")
    arcade(scene, stone, trim)
    urn = scene.mesh("urn", [(lathe(URN, 16).smoothed(), bronze)])
    for i, x in enumerate((-4.5, 1.5)):
        for z in (-2.2, 2.2):
            scene.place(urn, f"urn {i} {'left' if z < 0.0 else 'right'}", (x, 0.0, z))
    scene.camera((-8.2, 2.4, 0.9), (6.0, 3.6, -0.6), 1.05)
    scene.point_light((1.5, 6.2, 0.6), (1.0, 0.95, 0.85), 260.0)
    return scene
