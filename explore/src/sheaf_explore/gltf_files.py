# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The files that a glTF scene refers to, by the names that the simulator's loader gives them."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote

_GLB_HEADER = struct.Struct("<4s4x4xI4s")  # magic, version, length; length and type of a chunk


def referred_files(scene: Path) -> list[Path]:
    """Files of the buffers and images of a .gltf or .glb, sorted, whether they are there or not.

    None of a file that is no glTF: the simulator will say so better.
    """
    document = _document(scene)
    entries = [
        entry
        for key in ("buffers", "images")
        if isinstance(document, dict) and isinstance(document.get(key), list)
        for entry in document[key]
    ]
    uris = [entry.get("uri") for entry in entries if isinstance(entry, dict)]
    names = {
        unquote(uri, errors="surrogateescape")
        for uri in uris
        if isinstance(uri, str) and not uri.startswith("data:")
    }
    return sorted(scene.parent / name for name in names)


def _document(scene: Path) -> Any:
    try:
        return json.loads(_json_bytes(scene).decode("utf-8-sig", errors="replace"))
    except (ValueError, RecursionError):
        return None


def _json_bytes(scene: Path) -> bytes:
    """All of a .gltf, the first chunk of a .glb: told apart as in the loader, by what they hold."""
    with scene.open("rb") as stream:
        head = stream.read(_GLB_HEADER.size)
        if len(head) < _GLB_HEADER.size or not head.startswith(b"glTF"):
            return head + stream.read()
        _, length, _ = _GLB_HEADER.unpack(head)
        return stream.read(length)
