# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A writer of binary glTF 2.0 files, small enough to read in one go.

Plain meshes are quantized: interleaved SHORT positions and BYTE normals, 12 bytes a vertex, with
the scale and offset in the node. Meshes meant for EXT_mesh_gpu_instancing keep float positions,
because an instance's transform stands between the node's and the vertex and has no room for both.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from recipes.mesh import Mesh, bounds
from recipes.vec import ORIGIN, Quat, Vec3, cross, mix, quat_look, sub

BYTE, UNSIGNED_SHORT, SHORT, FLOAT = 5120, 5123, 5122, 5126
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
SHORT_MAX, BYTE_MAX = 32767, 127
# Index 65535 restarts a primitive on some hardware, so glTF forbids it.
MAX_VERTICES = 65535

Json = dict[str, Any]


@dataclass(frozen=True)
class MeshHandle:
    index: int
    triangles: int
    centre: Vec3
    half_extent: float  # 0 where positions are floats


def _round_list(values: Sequence[float]) -> list[float]:
    """Few digits keep the JSON readable; round() is correctly rounded, hence reproducible."""
    return [round(value, 7) + 0.0 for value in values]


def _snorm(value: float, largest: int) -> int:
    return max(-largest, min(largest, round(value * largest)))


class GlbWriter:
    def __init__(self, name: str) -> None:
        self._binary = bytearray()
        self._extensions: set[str] = set()
        self._required: set[str] = set()
        self._triangles = 0
        self._document: Json = {
            "asset": {
                "version": "2.0",
                "generator": "Sheaf scene recipes",
                "copyright": "2026 The Sheaf authors, Apache-2.0",
            },
            "scene": 0,
            "scenes": [{"name": name, "nodes": []}],
        }

    @property
    def triangles(self) -> int:
        """Triangles in the scene, each instance counted."""
        return self._triangles

    def material(
        self,
        name: str,
        colour: Vec3,
        metallic: float = 0.5,
        *,
        transmission: float = 0.0,
        ior: float = 1.5,
        texture: bytes | None = None,
        double_sided: bool = False,
    ) -> int:
        """Smooth, so that the metallic share of it is a mirror."""
        pbr: Json = {
            "baseColorFactor": [*_round_list(colour), 1.0],
            "metallicFactor": metallic,
            "roughnessFactor": 0.0,
        }
        if texture is not None:
            pbr["baseColorTexture"] = {"index": self._texture(name, texture)}
        material: Json = {"name": name, "pbrMetallicRoughness": pbr}
        if double_sided:
            material["doubleSided"] = True
        if transmission > 0.0:
            self._extensions |= {"KHR_materials_transmission", "KHR_materials_ior"}
            material["extensions"] = {
                "KHR_materials_transmission": {"transmissionFactor": transmission},
                "KHR_materials_ior": {"ior": ior},
            }
        return self._append("materials", material)

    def mesh(
        self, name: str, parts: Sequence[tuple[Mesh, int]], *, quantized: bool = True
    ) -> MeshHandle:
        """A mesh with one primitive for each (mesh, material)."""
        centre, half = ORIGIN, 0.0
        if quantized:
            self._extensions.add("KHR_mesh_quantization")
            self._required.add("KHR_mesh_quantization")
            low, high = bounds(part for part, _ in parts)
            centre = mix(low, high, 0.5)
            # One scale for all axes: an uneven one would turn the normals.
            half = max(high[i] - low[i] for i in range(3)) * 0.5
        primitives = []
        for part, material in parts:
            attributes = self._quantized(part, centre, half) if quantized else self._plain(part)
            indices = self._indices(part)
            primitives.append({"attributes": attributes, "indices": indices, "material": material})
        index = self._append("meshes", {"name": name, "primitives": primitives})
        triangles = 0
        for part, _ in parts:
            triangles += len(part.triangles)
        return MeshHandle(index, triangles, centre, half)

    def place(
        self,
        handle: MeshHandle,
        name: str,
        translation: Vec3 = ORIGIN,
        rotation: Quat | None = None,
        scale: Vec3 | None = None,
    ) -> None:
        """Put a mesh into the scene: a node, and under it the one that undoes the quantization."""
        self._triangles += handle.triangles
        child: Json = {"name": name, "mesh": handle.index}
        if handle.half_extent > 0.0:
            child["translation"] = list(handle.centre)
            child["scale"] = [handle.half_extent] * 3
        if translation == ORIGIN and rotation is None and scale is None:
            self._root(child)
            return
        child["name"] = name + ".grid"
        node: Json = {"name": name, "translation": _round_list(translation)}
        if rotation is not None:
            node["rotation"] = _round_list(rotation)
        if scale is not None:
            node["scale"] = _round_list(scale)
        node["children"] = [self._append("nodes", child)]
        self._root(node)

    def place_many(
        self,
        handle: MeshHandle,
        name: str,
        translations: Sequence[Vec3],
        rotations: Sequence[Quat] | None = None,
        scales: Sequence[Vec3] | None = None,
    ) -> None:
        """Put many copies of a float mesh into the scene by one node."""
        if handle.half_extent > 0.0:
            raise ValueError(f"{name}: instanced meshes keep float positions")
        self._triangles += handle.triangles * len(translations)
        self._extensions.add("EXT_mesh_gpu_instancing")
        self._required.add("EXT_mesh_gpu_instancing")
        attributes = {"TRANSLATION": self._floats(translations)}
        if rotations is not None:
            attributes["ROTATION"] = self._rotations(rotations)
        if scales is not None:
            attributes["SCALE"] = self._floats(scales)
        instancing = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
        self._root({"name": name, "mesh": handle.index, "extensions": instancing})

    def camera(self, eye: Vec3, target: Vec3, yfov: float) -> None:
        perspective = {"aspectRatio": 4.0 / 3.0, "yfov": yfov, "znear": 0.01, "zfar": 1000.0}
        index = self._append("cameras", {"type": "perspective", "perspective": perspective})
        pose = {"translation": _round_list(eye), "rotation": _round_list(quat_look(eye, target))}
        self._root({"name": "camera", "camera": index, **pose})

    def point_light(self, position: Vec3, colour: Vec3, intensity: float) -> None:
        """A point light; intensity in candela."""
        light = {"type": "point", "color": _round_list(colour), "intensity": intensity}
        self._extensions.add("KHR_lights_punctual")
        extension = self._document.setdefault("extensions", {})
        lights = extension.setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(light)
        reference = {"KHR_lights_punctual": {"light": len(lights) - 1}}
        self._root({"name": "light", "translation": _round_list(position), "extensions": reference})

    def to_bytes(self) -> bytes:
        document = dict(self._document)
        document["extensionsUsed"] = sorted(self._extensions)
        if self._required:
            document["extensionsRequired"] = sorted(self._required)
        document["buffers"] = [{"byteLength": len(self._binary)}]
        text = json.dumps(document, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        binary = bytes(self._binary) + bytes(-len(self._binary) % 4)
        total = 12 + 8 + len(text) + 8 + len(binary)
        header = struct.pack("<4sII", b"glTF", 2, total)
        json_chunk = struct.pack("<I4s", len(text), b"JSON") + text
        return header + json_chunk + struct.pack("<I4s", len(binary), b"BIN\0") + binary

    def _append(self, key: str, item: Json) -> int:
        items: list[Json] = self._document.setdefault(key, [])
        items.append(item)
        return len(items) - 1

    def _root(self, node: Json) -> None:
        self._document["scenes"][0]["nodes"].append(self._append("nodes", node))

    def _view(self, data: bytes, target: int | None = None, stride: int | None = None) -> int:
        self._binary += bytes(-len(self._binary) % 4)
        view: Json = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(data)}
        if stride is not None:
            view["byteStride"] = stride
        if target is not None:
            view["target"] = target
        self._binary += data
        return self._append("bufferViews", view)

    def _accessor(self, view: int, component: int, count: int, kind: str, **more: object) -> int:
        base: Json = {"bufferView": view, "componentType": component, "count": count, "type": kind}
        return self._append("accessors", {**base, **more})

    def _quantized(self, mesh: Mesh, centre: Vec3, half: float) -> dict[str, int]:
        count = len(mesh.positions)
        points = [
            tuple(_snorm(c / half, SHORT_MAX) for c in sub(p, centre)) for p in mesh.positions
        ]
        _refuse_degenerate(mesh, points)
        smooth = len(mesh.normals) > 0
        if smooth:
            normals = [tuple(_snorm(c, BYTE_MAX) for c in n) for n in mesh.normals]
            rows = zip(points, normals, strict=True)
            data = b"".join([struct.pack("<3h2x3bx", *p, *n) for p, n in rows])
        else:
            data = b"".join([struct.pack("<3h2x", *p) for p in points])
        view = self._view(data, ARRAY_BUFFER, 12 if smooth else 8)
        extent = _extent(points)
        attributes = {
            "POSITION": self._accessor(view, SHORT, count, "VEC3", normalized=True, **extent)
        }
        if smooth:
            attributes["NORMAL"] = self._accessor(
                view, BYTE, count, "VEC3", byteOffset=8, normalized=True
            )
        return attributes | self._uvs(mesh)

    def _plain(self, mesh: Mesh) -> dict[str, int]:
        # min and max must equal the stored values, so round to single precision first.
        points = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in mesh.positions]
        _refuse_degenerate(mesh, points)
        view = self._view(b"".join([struct.pack("<3f", *p) for p in points]), ARRAY_BUFFER)
        attributes = {
            "POSITION": self._accessor(view, FLOAT, len(points), "VEC3", **_extent(points))
        }
        if mesh.normals:
            data = b"".join([struct.pack("<3f", *n) for n in mesh.normals])
            view = self._view(data, ARRAY_BUFFER)
            attributes["NORMAL"] = self._accessor(view, FLOAT, len(points), "VEC3")
        return attributes | self._uvs(mesh)

    def _uvs(self, mesh: Mesh) -> dict[str, int]:
        if not mesh.uvs:
            return {}
        view = self._view(b"".join([struct.pack("<2f", *uv) for uv in mesh.uvs]), ARRAY_BUFFER)
        return {"TEXCOORD_0": self._accessor(view, FLOAT, len(mesh.uvs), "VEC2")}

    def _indices(self, mesh: Mesh) -> int:
        if len(mesh.positions) > MAX_VERTICES:
            raise ValueError("too many vertices for 16-bit indices")
        data = b"".join([struct.pack("<3H", *t) for t in mesh.triangles])
        view = self._view(data, ELEMENT_ARRAY_BUFFER)
        return self._accessor(view, UNSIGNED_SHORT, len(mesh.triangles) * 3, "SCALAR")

    def _floats(self, rows: Sequence[Vec3]) -> int:
        view = self._view(b"".join([struct.pack("<3f", *row) for row in rows]))
        return self._accessor(view, FLOAT, len(rows), "VEC3")

    def _rotations(self, rotations: Sequence[Quat]) -> int:
        rows = [[_snorm(c, SHORT_MAX) for c in q] for q in rotations]
        view = self._view(b"".join([struct.pack("<4h", *row) for row in rows]))
        return self._accessor(view, SHORT, len(rows), "VEC4", normalized=True)

    def _texture(self, name: str, png: bytes) -> int:
        view = self._view(png)
        image = self._append("images", {"name": name, "bufferView": view, "mimeType": "image/png"})
        # Linear filtering without mipmaps, repeating.
        sampler = self._append(
            "samplers", {"magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497}
        )
        return self._append("textures", {"sampler": sampler, "source": image})


def _extent(points: Sequence[tuple[float, ...]]) -> Json:
    columns = list(zip(*points, strict=True))
    return {"min": [min(c) for c in columns], "max": [max(c) for c in columns]}


def _refuse_degenerate(mesh: Mesh, points: Sequence[tuple[float, ...]]) -> None:
    """Quantization may flatten a thin triangle; the recipe, not the file, should change then."""
    for a, b, c in mesh.triangles:
        p, q, r = points[a], points[b], points[c]
        u, v = (q[0] - p[0], q[1] - p[1], q[2] - p[2]), (r[0] - p[0], r[1] - p[1], r[2] - p[2])
        if cross(u, v) == (0, 0, 0):
            raise ValueError(f"degenerate triangle {a} {b} {c} at {mesh.positions[a]}")
