# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A scene's name follows every file it is made of, however their names are written."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from pathlib import Path

import pytest

from sheaf_explore.gltf_files import referred_files
from sheaf_explore.simulator import hash_source
from sheaf_explore.spec import Source


def gltf(text: str) -> bytes:
    return text.encode()


def glb(text: str) -> bytes:
    chunk = text.encode()
    chunk += b" " * (-len(chunk) % 4)
    binary = struct.pack("<I4s4s", 4, b"BIN\0", b"\xff\xfe{}")
    size = 20 + len(chunk) + len(binary)
    return struct.pack("<4sIII4s", b"glTF", 2, size, len(chunk), b"JSON") + chunk + binary


@pytest.mark.parametrize("wrap", [gltf, glb])
@pytest.mark.parametrize("key", ["buffers", "images"])
@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("mesh.bin", "mesh.bin"),
        ("my%20mesh.bin", "my mesh.bin"),
        ("m\\u00e9sh\\u002ebin", "mésh.bin"),
        ("m%C3%A9sh.bin", "mésh.bin"),
        ("50%.bin", "50%.bin"),
        ("parts\\/mesh.bin", "parts/mesh.bin"),
    ],
)
def test_an_edited_part_gives_a_scene_another_name(
    tmp_path: Path, wrap: Callable[[str], bytes], key: str, written: str, name: str
) -> None:
    scene = tmp_path / "scene.file"
    scene.write_bytes(wrap(f'{{"{key}": [{{"uri": "{written}"}}]}}'))
    part = tmp_path / name
    part.parent.mkdir(exist_ok=True)
    hashes = set()
    for content in (None, "before", "after"):
        if content is not None:
            part.write_text(content)
        hashes.add(hash_source(Source("scene", scene, "scene")))
    assert len(hashes) == 3


@pytest.mark.parametrize(
    "text",
    [
        "",
        "no JSON",
        "[" * 100_000,
        "[]",
        '{"buffers": {"uri": "a"}}',
        '{"buffers": [3, {}, {"uri": 4}]}',
        '{"buffers": [{"uri": "data:;base64,AAAA"}]}',
    ],
)
def test_what_refers_to_no_file_is_named_by_itself(tmp_path: Path, text: str) -> None:
    scene = tmp_path / "scene.gltf"
    scene.write_text(text)
    assert referred_files(scene) == []


def test_names_that_no_file_can_have_are_left_to_the_simulator(tmp_path: Path) -> None:
    scene = tmp_path / "scene.gltf"
    uris = ["a%00b", "\ud800", "x" * 5000, "."]
    scene.write_text(json.dumps({"images": [{"uri": uri} for uri in uris]}))
    assert hash_source(Source("scene", scene, "scene"))
