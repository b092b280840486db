# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""glTF scenes of mirrors, small enough for hundreds of runs."""

from __future__ import annotations

import base64
import json
import struct

Quad = list[tuple[float, float, float]]

_QUADS: list[Quad] = [
    [(-2, 0, -2), (2, 0, -2), (2, 0, 2), (-2, 0, 2)],
    [(-2, 0, -2), (-2, 2, -2), (2, 2, -2), (2, 0, -2)],
]


def stairs(steps: int) -> list[Quad]:
    """Mirroring steps, enough for a tree with inner nodes."""
    quads: list[Quad] = []
    for i in range(steps):
        y, z = float(i), -float(i)
        quads.append([(-4, y, z), (4, y, z), (4, y + 1, z), (-4, y + 1, z)])
        quads.append([(-4, y + 1, z), (4, y + 1, z), (4, y + 1, z - 1), (-4, y + 1, z - 1)])
    return quads


def tiny_gltf(quads: list[Quad] = _QUADS) -> str:
    """The scene as text, its one buffer inside."""
    vertices = [corner for quad in quads for corner in quad]
    indices = [4 * q + i for q in range(len(quads)) for i in (0, 1, 2, 0, 2, 3)]
    positions = b"".join(struct.pack("<3f", *vertex) for vertex in vertices)
    data = positions + struct.pack(f"<{len(indices)}H", *indices)
    lows = [min(v[i] for v in vertices) for i in range(3)]
    highs = [max(v[i] for v in vertices) for i in range(3)]
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": len(vertices), "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"},
    ]
    accessors[0] |= {"min": lows, "max": highs}
    mirror = {"metallicFactor": 1.0, "roughnessFactor": 0.0}
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": mirror}],
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(data) - len(positions)},
        ],
        "buffers": [{"byteLength": len(data), "uri": uri}],
    }
    return json.dumps(document)
