# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A glTF scene of a mirror floor and a wall, small enough for hundreds of runs."""

from __future__ import annotations

import base64
import json
import struct

_QUADS = [
    [(-2, 0, -2), (2, 0, -2), (2, 0, 2), (-2, 0, 2)],
    [(-2, 0, -2), (-2, 2, -2), (2, 2, -2), (2, 0, -2)],
]


def tiny_gltf() -> str:
    """The scene as text, its one buffer inside."""
    vertices = [corner for quad in _QUADS for corner in quad]
    indices = [4 * q + i for q in range(len(_QUADS)) for i in (0, 1, 2, 0, 2, 3)]
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
