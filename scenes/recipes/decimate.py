# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Fewer triangles for a mesh, by collapsing the edges that change its shape least.

Garland and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997. An edge
collapses to the best of its ends and its middle; the same mesh gives the same result.
"""

from __future__ import annotations

import heapq

from recipes.mesh import Mesh
from recipes.vec import Vec3, cross, dot, mix, sub, unit

# The symmetric 4 x 4 matrix of squared distances to planes, upper triangle row by row.
Quadric = tuple[float, ...]


def _plane(a: Vec3, b: Vec3, c: Vec3) -> Quadric:
    normal = unit(cross(sub(b, a), sub(c, a)))
    plane = (*normal, -dot(normal, a))
    return tuple(plane[i] * plane[j] for i in range(4) for j in range(i, 4))


def _sum(a: Quadric, b: Quadric) -> Quadric:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def _error(q: Quadric, p: Vec3) -> float:
    x, y, z = p
    squares = q[0] * x * x + q[4] * y * y + q[7] * z * z + q[9]
    return squares + 2.0 * (q[1] * x * y + q[2] * x * z + q[3] * x + q[5] * y * z + q[6] * y + q[8] * z)


class _Decimator:
    """A mesh while it shrinks. A vertex that is gone has no faces left."""

    def __init__(self, mesh: Mesh) -> None:
        self.points = list(mesh.positions)
        self.faces = {i: face for i, face in enumerate(mesh.triangles) if self._solid(face)}
        self.at: list[set[int]] = [set() for _ in self.points]
        self.quadrics: list[Quadric] = [(0.0,) * 10 for _ in self.points]
        for i, face in self.faces.items():
            plane = _plane(*(self.points[v] for v in face))
            for v in face:
                self.at[v].add(i)
                self.quadrics[v] = _sum(self.quadrics[v], plane)
        self.changes = [0] * len(self.points)
        self.heap: list[tuple[float, int, int, int, int]] = []
        for v in range(len(self.points)):
            self._offer(v, [w for w in self._neighbours(v) if w > v])

    def _solid(self, face: tuple[int, int, int]) -> bool:
        a, b, c = (self.points[v] for v in face)
        return cross(sub(b, a), sub(c, a)) != (0.0, 0.0, 0.0)

    def _neighbours(self, v: int) -> list[int]:
        return sorted({w for i in self.at[v] for w in self.faces[i]} - {v})

    def _place(self, v: int, w: int) -> tuple[float, Vec3]:
        total = _sum(self.quadrics[v], self.quadrics[w])
        a, b = self.points[v], self.points[w]
        return min((_error(total, p), p) for p in (a, b, mix(a, b, 0.5)))

    def _offer(self, v: int, others: list[int]) -> None:
        for w in others:
            low, high = min(v, w), max(v, w)
            entry = (self._place(v, w)[0], low, high, self.changes[low], self.changes[high])
            heapq.heappush(self.heap, entry)

    def _turns_over(self, v: int, gone: int, place: Vec3) -> bool:
        """Whether a face that stays would come to face the other way."""
        for i in self.at[v] - self.at[gone]:
            before = [self.points[u] for u in self.faces[i]]
            after = [place if u == v else self.points[u] for u in self.faces[i]]
            normals = [cross(sub(b, a), sub(c, a)) for a, b, c in (before, after)]
            if dot(*normals) <= 0.0:
                return True
        return False

    def _collapse(self, v: int, w: int) -> None:
        _, place = self._place(v, w)
        if self._turns_over(v, w, place) or self._turns_over(w, v, place):
            return
        for i in self.at[v] & self.at[w]:
            for u in self.faces.pop(i):
                self.at[u].discard(i)
        for i in self.at[w]:
            a, b, c = (v if u == w else u for u in self.faces[i])
            self.faces[i] = (a, b, c)
        self.at[v] |= self.at[w]
        self.at[w] = set()
        self.points[v] = place
        self.quadrics[v] = _sum(self.quadrics[v], self.quadrics[w])
        self.changes[v] += 1
        self.changes[w] += 1
        self._offer(v, self._neighbours(v))

    def run(self, triangles: int) -> Mesh:
        while len(self.faces) > triangles and self.heap:
            _, v, w, change_v, change_w = heapq.heappop(self.heap)
            if (change_v, change_w) == (self.changes[v], self.changes[w]):
                self._collapse(v, w)
        kept = [v for v, faces in enumerate(self.at) if faces]
        number = {v: i for i, v in enumerate(kept)}
        solid = [face for face in self.faces.values() if self._solid(face)]
        faces = [(number[a], number[b], number[c]) for a, b, c in solid]
        return Mesh([self.points[v] for v in kept], faces)


def decimated(mesh: Mesh, triangles: int) -> Mesh:
    """A mesh of at most so many triangles, or a little more where nothing can collapse."""
    return _Decimator(mesh).run(triangles)
