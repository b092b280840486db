# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Reads traces that `sheaf run --record` wrote, as traces/README.md describes them."""

from __future__ import annotations

import json
import struct
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import xxhash

from sheaf_explore.errors import ExploreError

_MAGIC = b"\x89SHEAF\r\n"
_VERSION = 1
_HEADER, _FRAME, _INDEX, _TRAILER = 64, 48, 32, 48
_LARGEST = 1 << 24
_KINDS = {1: "rays", 2: "memory"}
_RAY_KINDS = np.array(["primary", "reflection", "refraction"])
_FLOATS = (
    *("origin_x", "origin_y", "origin_z", "direction_x", "direction_y", "direction_z"),
    *("t_max", "weight_r", "weight_g", "weight_b"),
)
_BLOCK = 16


@dataclass(frozen=True)
class _Frame:
    offset: int
    key: int
    records: int
    unpacked: int
    stored: int
    type: int


def _checksum(data: bytes, seed: int) -> int:
    return xxhash.xxh3_64_intdigest(data, seed)


class Trace:
    """An open trace: its header, metadata and index have been checked; frames are when read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._file = path.open("rb")
        except OSError as error:
            raise ExploreError(f"{path}: cannot be read: {error.strerror}") from error
        self.size = self._file.seek(0, 2)
        self._read_header()
        frames = self._read_index()
        self.frames = frames[:-1]
        self.metadata: dict[str, Any] = json.loads(self._unpack(frames[-1]))

    def _refuse(self, offset: int, problem: str) -> ExploreError:
        return ExploreError(f"{self.path}: byte {offset}: {problem}; record it again")

    def _read(self, offset: int, size: int) -> bytes:
        self._file.seek(offset)
        data = self._file.read(size)
        if len(data) != size:
            raise self._refuse(offset, f"{size} bytes cannot be read")
        return data

    def _read_header(self) -> None:
        header = self._read(0, min(self.size, _HEADER))
        if header[:8] != _MAGIC or len(header) < _HEADER:
            raise ExploreError(f"{self.path}: is no trace of Sheaf")
        version, kind = struct.unpack_from("<II", header, 8)
        if version != _VERSION:
            raise self._refuse(8, f"is of version {version}, this reader knows {_VERSION}")
        if _checksum(header[:56], 0) != struct.unpack_from("<Q", header, 56)[0]:
            raise self._refuse(0, "the header does not match its checksum")
        if kind not in _KINDS:
            raise self._refuse(12, f"there is no kind of trace {kind}")
        self.kind = _KINDS[kind]
        self.scene_hash, self.config_hash = header[16:32].hex(), header[32:48].hex()

    def _read_index(self) -> list[_Frame]:
        at = self.size - _TRAILER
        if at < _HEADER:
            raise self._refuse(self.size, "the file is truncated")
        trailer = self._read(at, _TRAILER)
        index, frames, self.records, size, magic, checksum = struct.unpack("<QQQQ8sQ", trailer)
        if magic != b"SHEAFEND" or _checksum(trailer[:40], 0) != checksum or size != self.size:
            raise self._refuse(at, "the file does not end with its trailer")
        stored = at - index - _FRAME
        entries = self._unpack(_Frame(index, 0, frames, frames * _INDEX, stored, 3))
        listed = [
            _Frame(*struct.unpack_from("<QQIIII", entries, i * _INDEX)) for i in range(frames)
        ]
        place = _HEADER
        for frame in listed:
            if frame.offset != place or frame.type != (2 if frame is listed[-1] else 1):
                raise self._refuse(index, "the index does not fit the file")
            place += _FRAME + frame.stored
        if not listed or place != index:
            raise self._refuse(index, "the index does not fit the file")
        return listed

    def _unpack(self, frame: _Frame) -> bytes:
        header = self._read(frame.offset, _FRAME)
        magic, kind, key, records, unpacked, stored, zero, checksum, own = struct.unpack(
            "<4sIQIIIIQQ", header
        )
        if _checksum(header[:40], frame.offset) != own or magic != b"FRAM" or zero != 0:
            raise self._refuse(frame.offset, "the frame's header does not match its checksum")
        if _Frame(frame.offset, key, records, unpacked, stored, kind) != frame:
            raise self._refuse(frame.offset, "the frame does not match the index")
        if unpacked > _LARGEST and kind != 3:
            raise self._refuse(frame.offset, "the frame is too large")
        content = self._read(frame.offset + _FRAME, stored)
        if _checksum(content, frame.offset) != checksum:
            raise self._refuse(frame.offset, "the frame does not match its checksum")
        try:
            return bytes(pa.decompress(content, unpacked, codec="zstd", asbytes=True))
        except (OSError, pa.ArrowException) as error:
            raise self._refuse(frame.offset, f"the frame cannot be unpacked: {error}") from error

    def tables(self) -> Iterator[dict[str, pd.DataFrame]]:
        """The tables of each data frame: rays and spawned, or accesses and chains."""
        for frame in self.frames:
            columns = _Columns(self._unpack(frame))
            try:
                yield self._decode(frame, columns)
            except (ValueError, IndexError, KeyError, OverflowError) as error:
                problem = f"in the frame that begins here, {error}"
                raise self._refuse(frame.offset, problem) from error

    def _decode(self, frame: _Frame, columns: _Columns) -> dict[str, pd.DataFrame]:
        if self.kind == "rays":
            tables = _rays(frame, columns, self.metadata["image"])
        else:
            tables = _accesses(frame, columns, self.metadata["memory"])
        columns.finish()
        return tables


class _Columns:
    """The columns of a frame, in order."""

    def __init__(self, raw: bytes) -> None:
        self._raw = raw
        self._at = 0

    def _next(self) -> np.ndarray:
        if len(self._raw) - self._at < 4:
            raise ValueError("a column is missing")
        (length,) = struct.unpack_from("<I", self._raw, self._at)
        self._at += 4
        if len(self._raw) - self._at < length:
            raise ValueError("a column is longer than the frame")
        self._at += length
        return np.frombuffer(self._raw, np.uint8, length, self._at - length)

    def bytes(self, count: int) -> np.ndarray:
        return self._sized(count)

    def _sized(self, size: int) -> np.ndarray:
        column = self._next()
        if len(column) != size:
            raise ValueError("a column has another length than its records")
        return column

    def longs(self, count: int) -> np.ndarray:
        return self._sized(8 * count).view("<u8")

    def words(self, count: int) -> np.ndarray:
        planes = self._sized(4 * count).reshape(4, count).astype(np.uint32)
        changes = planes[0] | planes[1] << 8 | planes[2] << 16 | planes[3] << 24
        return np.bitwise_xor.accumulate(changes).astype(np.uint32).view(np.float32)

    def numbers(self, count: int) -> np.ndarray:
        column = self._next()
        ends = np.flatnonzero(column < 0x80)
        if (
            len(ends) != count
            or (count and ends[-1] != len(column) - 1)
            or (count == 0 and len(column))
        ):
            raise ValueError("a column has another number of numbers than its records")
        if count == 0:
            return np.zeros(0, np.uint64)
        begins = np.concatenate(([0], ends[:-1] + 1))
        place = np.arange(len(column)) - np.repeat(begins, ends - begins + 1)
        if place.max() > 9:
            raise ValueError("a number has more than 64 bits")
        parts = (column & 0x7F).astype(np.uint64) << (7 * place).astype(np.uint64)
        return np.add.reduceat(parts, begins)

    def finish(self) -> None:
        if self._at != len(self._raw):
            raise ValueError("there is more than its columns")


def _signed(codes: np.ndarray) -> np.ndarray:
    return (codes >> np.uint64(1)).astype(np.int64) ^ -(codes & np.uint64(1)).astype(np.int64)


def _rays(frame: _Frame, columns: _Columns, image: dict[str, int]) -> dict[str, pd.DataFrame]:
    count = frame.records
    position = columns.bytes(count).astype(np.int64)
    flags = columns.bytes(count)
    depth = columns.bytes(count)
    kind = flags & 3
    ids = np.zeros(count, np.uint64)
    ids[kind != 0] = columns.longs(int(np.count_nonzero(kind != 0)))
    packet = np.cumsum(_signed(columns.numbers(count)))
    children = columns.numbers(count).astype(np.int64)
    across = -(-image["width"] // _BLOCK)
    row = frame.key // across * _BLOCK + position // _BLOCK
    column = frame.key % across * _BLOCK + position % _BLOCK
    if np.any(row >= image["height"]) or np.any(column >= image["width"]):
        raise ValueError("a ray has no pixel")
    pixel = row * image["width"] + column
    ids[kind == 0] = _mix(pixel[kind == 0].astype(np.uint64) + np.uint64(1))
    total = int(children.sum())
    slot = columns.numbers(total)
    floats = {name: columns.words(total) for name in _FLOATS}
    parent = np.repeat(ids, children)
    rays = pd.DataFrame(
        {
            "pixel": pixel,
            "id": ids,
            "kind": _RAY_KINDS[kind],
            "depth": depth,
            "packet": packet,
            "hit": (flags & 4) != 0,
            "contributes": (flags & 8) != 0,
            "children": children,
        }
    )
    step = np.uint64(0x9E3779B97F4A7C15)
    identity = {
        "parent": parent,
        "id": _mix(parent + (slot + np.uint64(1)) * step),
        "slot": slot,
    }
    return {"rays": rays, "spawned": pd.DataFrame(identity | floats)}


def _mix(x: np.ndarray) -> np.ndarray:
    x = (x ^ x >> np.uint64(30)) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ x >> np.uint64(27)) * np.uint64(0x94D049BB133111EB)
    return np.asarray(x ^ x >> np.uint64(31))


def _accesses(frame: _Frame, columns: _Columns, memory: Any) -> dict[str, pd.DataFrame]:
    count = frame.records
    stream = memory["streams"][frame.key >> 48]
    first = frame.key & (1 << 48) - 1
    context = columns.bytes(count)
    cycle = np.cumsum(columns.numbers(count))
    code = columns.numbers(count)
    operation = (code >> np.uint64(3)).astype(np.int64)
    table = memory["operations"]
    size = np.array([entry["bytes"] for entry in table])[operation]
    kind = np.array([entry["kind"] for entry in table])[operation]
    access = size != 0
    number = first + np.arange(count)
    accesses = pd.DataFrame(
        {
            "stream": stream["name"],
            "record": number,
            "context": context,
            "cycle": cycle,
            "address": np.zeros(count, np.uint64),
            "bytes": size,
            "kind": np.where(access, kind, ""),
            "write": np.array([entry["write"] for entry in table])[operation],
            "begins": (code & np.uint64(1)) != 0,
            "continues": (code & np.uint64(2)) != 0,
            "ends": (code & np.uint64(4)) != 0,
        }
    )
    change = _signed(columns.numbers(int(np.count_nonzero(access))))
    last = pd.DataFrame({"context": context[access], "kind": kind[access], "change": change})
    address = last.groupby(["context", "kind"], sort=False)["change"].cumsum()
    accesses.loc[access, "address"] = address.to_numpy().astype(np.uint64)
    begins = number[accesses["begins"].to_numpy()]
    causes = [columns.numbers(len(begins)) for _ in range(4)]
    cause, which, gap, epoch = causes
    seen: dict[int, int] = defaultdict(int)
    record = np.zeros(len(begins), np.int64)
    for i, (source, step) in enumerate(zip(cause.tolist(), _signed(which).tolist(), strict=True)):
        seen[source] += step
        record[i] = seen[source]
    names = np.array(["", *(entry["name"] for entry in memory["streams"])])
    chains = pd.DataFrame(
        {
            "stream": stream["name"],
            "record": begins,
            "cause": names[cause.astype(np.int64)],
            "cause_record": record >> 1,
            "cause_ended": (record & 1) != 0,
            "gap": gap,
            "epoch": np.cumsum(epoch),
        }
    )
    return {"accesses": accesses, "chains": chains}


def write_parquet(trace: Trace, folder: Path) -> list[Path]:
    """Each table of the trace as a Parquet file in the folder, frame by frame."""
    folder.mkdir(parents=True, exist_ok=True)
    writers: dict[str, pq.ParquetWriter] = {}
    try:
        for tables in trace.tables():
            for name, frame in tables.items():
                table = pa.Table.from_pandas(frame, preserve_index=False)
                if name not in writers:
                    partial = folder / f"{name}.parquet.partial"
                    writers[name] = pq.ParquetWriter(partial, table.schema)
                writers[name].write_table(table)
    finally:
        for writer in writers.values():
            writer.close()
    paths = [folder / f"{name}.parquet" for name in writers]
    for path in paths:
        path.with_name(path.name + ".partial").replace(path)
    return paths


def read_tables(path: Path) -> dict[str, pd.DataFrame]:
    """All tables of a trace at once."""
    parts: dict[str, list[pd.DataFrame]] = defaultdict(list)
    for tables in Trace(path).tables():
        for name, frame in tables.items():
            parts[name].append(frame)
    return {name: pd.concat(frames, ignore_index=True) for name, frames in parts.items()}
