# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes and the few shapes that all scenes are made of.

Every shape is wound counter-clockwise as seen from outside.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from recipes.vec import (
    ORIGIN,
    Vec3,
    add,
    along,
    cos_sin,
    cross,
    dot,
    length,
    mul,
    perpendicular,
    sub,
    unit,
)

Frame = tuple[Vec3, Vec3, Vec3]  # up, side, forward; up x side = forward


@dataclass
class Mesh:
    """Indexed triangles. Without normals the loader shades the faces flat, as glTF asks."""

    positions: list[Vec3] = field(default_factory=list)
    triangles: list[tuple[int, int, int]] = field(default_factory=list)
    normals: list[Vec3] = field(default_factory=list)
    uvs: list[tuple[float, float]] = field(default_factory=list)

    def join(self, *others: Mesh) -> Mesh:
        for other in others:
            base = len(self.positions)
            self.positions += other.positions
            self.normals += other.normals
            self.uvs += other.uvs
            self.triangles += [(a + base, b + base, c + base) for a, b, c in other.triangles]
        return self

    def moved(self, place: Callable[[Vec3], Vec3]) -> Mesh:
        """A copy with every position replaced; made before normals are."""
        return Mesh([place(p) for p in self.positions], list(self.triangles), [], list(self.uvs))

    def flipped(self) -> Mesh:
        """A copy that faces the other way: after mirroring, or to see a box from inside."""
        turned = [(a, c, b) for a, b, c in self.triangles]
        return Mesh(list(self.positions), turned, [mul(n, -1.0) for n in self.normals], self.uvs)

    def mirrored_z(self) -> Mesh:
        return self.moved(lambda p: (p[0], p[1], -p[2])).flipped()

    def smoothed(self) -> Mesh:
        """Give each vertex the area-weighted mean normal of its faces."""
        self.normals = smooth_normals(self.positions, self.triangles)
        return self


def joined(meshes: Iterable[Mesh]) -> Mesh:
    return Mesh().join(*meshes)


def smooth_normals(positions: list[Vec3], triangles: list[tuple[int, int, int]]) -> list[Vec3]:
    totals = [ORIGIN] * len(positions)
    for triangle in triangles:
        a, b, c = (positions[i] for i in triangle)
        face = cross(sub(b, a), sub(c, a))
        for i in triangle:
            totals[i] = add(totals[i], face)
    return [unit(total) for total in totals]


def skin(
    rings: Sequence[Sequence[Vec3]],
    start: Vec3 | None = None,
    end: Vec3 | None = None,
    *,
    looped: bool = False,
) -> Mesh:
    """A tube through rings of equal size, closed by a fan to `start` and `end` if they are given.
    A looped one leads from the last ring to the first.

    Rings run counter-clockwise as seen from the end that they lead to.
    """
    sides = len(rings[0])
    mesh = Mesh([p for ring in rings for p in ring])
    count = len(rings)
    for j in range(count if looped else count - 1):
        here, there = j * sides, (j + 1) % count * sides
        for i in range(sides):
            k = (i + 1) % sides
            mesh.triangles += [(here + i, here + k, there + k), (here + i, there + k, there + i)]
    last = (len(rings) - 1) * sides
    if start is not None:
        mesh.positions.append(start)
        pole = len(mesh.positions) - 1
        mesh.triangles += [(pole, (i + 1) % sides, i) for i in range(sides)]
    if end is not None:
        mesh.positions.append(end)
        pole = len(mesh.positions) - 1
        mesh.triangles += [(pole, last + i, last + (i + 1) % sides) for i in range(sides)]
    return mesh


def frames(path: Sequence[Vec3], up: Vec3 | None = None) -> list[Frame]:
    """Frames carried along a path without twist (parallel transport)."""
    result: list[Frame] = []
    for i in range(len(path)):
        forward = unit(sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
        if up is None:
            up = perpendicular(forward)
        up = unit(along(up, forward, -dot(up, forward)))
        result.append((up, cross(forward, up), forward))
    return result


def ring(centre: Vec3, frame: Frame, sides: int, radius: Callable[[float], float]) -> list[Vec3]:
    """Points around `centre`; `radius` depends on the turn, which starts at the frame's up."""
    points = []
    for i in range(sides):
        c, s = cos_sin(i / sides)
        r = radius(i / sides)
        points.append(along(along(centre, frame[0], c * r), frame[1], s * r))
    return points


def sweep(path: Sequence[Vec3], radii: Sequence[float], sides: int, up: Vec3 | None = None) -> Mesh:
    """A round closed tube along a path. The last radius may be 0: then it ends in a point."""
    tips = radii[-1] == 0.0
    body = len(path) - 1 if tips else len(path)
    directions = frames(path, up)

    def round_ring(j: int) -> list[Vec3]:
        return ring(path[j], directions[j], sides, lambda _: radii[j])

    return skin([round_ring(j) for j in range(body)], path[0], path[-1])


def lathe(profile: Sequence[tuple[float, float]], sides: int, base: Vec3 = ORIGIN) -> Mesh:
    """A solid of revolution about the y axis from (radius, height) pairs.

    Radius 0 at an end closes it in a point; otherwise that end stays open.
    """
    first, last = profile[0], profile[-1]
    bottom = add(base, (0.0, first[1], 0.0)) if first[0] == 0.0 else None
    top = add(base, (0.0, last[1], 0.0)) if last[0] == 0.0 else None
    rings = []
    for r, y in profile:
        if r > 0.0:
            turns = [cos_sin(i / sides) for i in range(sides)]
            rings.append([add(base, (c * r, y, -s * r)) for c, s in turns])
    return skin(rings, bottom, top)


def ellipsoid(centre: Vec3, radii: Vec3, stacks: int, sides: int) -> Mesh:
    turns = [cos_sin(j / stacks * 0.5) for j in range(stacks + 1)]
    profile = [(s if 0 < j < stacks else 0.0, -c) for j, (c, s) in enumerate(turns)]
    return lathe(profile, sides).moved(
        lambda p: add(centre, (p[0] * radii[0], p[1] * radii[1], p[2] * radii[2]))
    )


def box(low: Vec3, high: Vec3) -> Mesh:
    corners = [
        (high[0] if i & 1 else low[0], high[1] if i & 2 else low[1], high[2] if i & 4 else low[2])
        for i in range(8)
    ]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return Mesh(corners, triangles)


def quad(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> Mesh:
    """Two triangles, front side where a, b, c, d runs counter-clockwise."""
    return Mesh([a, b, c, d], [(0, 1, 2), (0, 2, 3)])


def grid(rows: Sequence[Sequence[Vec3]]) -> Mesh:
    """An open surface through rows of points; rows lead away, columns to the right."""
    width = len(rows[0])
    mesh = Mesh([p for row in rows for p in row])
    for j in range(len(rows) - 1):
        for i in range(width - 1):
            a = j * width + i
            mesh.triangles += [(a, a + 1, a + width + 1), (a, a + width + 1, a + width)]
    return mesh


def sheet(rows: Sequence[Sequence[Vec3]], thickness: float) -> Mesh:
    """A closed sheet of even thickness about an open surface."""
    front = grid(rows)
    normals = smooth_normals(front.positions, front.triangles)
    count = len(front.positions)
    half = thickness * 0.5
    pairs = list(zip(front.positions, normals, strict=True))
    mesh = Mesh([along(p, n, half) for p, n in pairs] + [along(p, n, -half) for p, n in pairs])
    mesh.triangles = list(front.triangles)
    mesh.triangles += [(a + count, c + count, b + count) for a, b, c in front.triangles]
    edge = _outline(len(rows), len(rows[0]))
    for a, b in zip(edge, edge[1:] + edge[:1], strict=True):
        mesh.triangles += [(b, a, a + count), (b, a + count, b + count)]
    return mesh


def _outline(height: int, width: int) -> list[int]:
    """Indices around a grid, counter-clockwise as seen from its front."""
    last = (height - 1) * width
    bottom = list(range(width))
    right = [j * width + width - 1 for j in range(1, height)]
    top = [last + i for i in range(width - 2, -1, -1)]
    left = [j * width for j in range(height - 2, 0, -1)]
    return bottom + right + top + left


def cone(base: Vec3, tip: Vec3, radius: float, sides: int) -> Mesh:
    """A closed spike."""
    return sweep([base, tip], [radius, 0.0], sides)


def bounds(meshes: Iterable[Mesh]) -> tuple[Vec3, Vec3]:
    points = [p for mesh in meshes for p in mesh.positions]
    low = (min(p[0] for p in points), min(p[1] for p in points), min(p[2] for p in points))
    high = (max(p[0] for p in points), max(p[1] for p in points), max(p[2] for p in points))
    return low, high


def path_length(path: Sequence[Vec3]) -> float:
    total = 0.0
    for a, b in pairwise(path):
        total += length(sub(b, a))
    return total
