# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A writer of small RGB images as PNG.

The pixels are stored, not compressed: what a compressor makes of them may change with the version
of zlib, and the scenes must not.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

Pixel = tuple[int, int, int]

# Deflate's stored blocks hold at most this many bytes.
STORED_BLOCK = 65535


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _stored(data: bytes) -> bytes:
    """A zlib stream of stored blocks, written out by hand to leave zlib no choice."""
    stream = b"\x78\x01"
    for start in range(0, len(data), STORED_BLOCK):
        block = data[start : start + STORED_BLOCK]
        final = start + STORED_BLOCK >= len(data)
        stream += struct.pack("<BHH", final, len(block), len(block) ^ 0xFFFF) + block
    return stream + struct.pack(">I", zlib.adler32(data))


def rgb_png(rows: Sequence[Sequence[Pixel]]) -> bytes:
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    data = b"".join([b"\0" + bytes([c for pixel in row for c in pixel]) for row in rows])
    chunks = _chunk(b"IHDR", header) + _chunk(b"IDAT", _stored(data)) + _chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + chunks
