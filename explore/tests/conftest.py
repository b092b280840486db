# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""What tests share: a simulator, a tiny scene, a stand-in for the simulator, and specs."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from scene_maker import tiny_gltf

from sheaf_explore.cli import main
from sheaf_explore.simulator import Simulator

CHECKOUT = Path(__file__).parents[2]

# A stand-in for the simulator, quick and with misbehaviour on demand, chosen by dram.latency. It
# takes its schema from the file beside it and leaves one line a start in `starts`.
STAND_IN = """#!/bin/sh
here=$(dirname "$0")
[ "$1" = config ] && [ "$2" = --schema ] && exec cat "$here/schema.json"
[ "$1" = config ] && exit 0
[ "$1" = --help ] && { echo "  run"; exit 0; }
[ "$2" = --help ] && exit 0
latency=100; ways=8
while [ $# -gt 0 ]; do
  case "$1" in
    --out) out=$2 ;;
    dram.latency=*) latency=${1#*=} ;;
    l2.ways=*) ways=${1#*=} ;;
  esac
  shift
done
echo "$out" >> "$here/starts"
case $latency in
  13) echo "sheaf: dram.latency = 13 is bad luck" >&2; exit 2 ;;
  14) kill -9 $$ ;;
  15) exec sleep 60 ;;
  16) [ -e "$here/second" ] || { touch "$here/second"; kill -9 $$; } ;;
  17) exec true ;;
  18) sleep 0.2 ;;
  31) echo "sheaf: out: no space left" >&2; exit 4 ;;
  32) echo "sheaf: error while loading shared libraries: lib.so" >&2; exit 127 ;;
esac
mkdir -p "$out"
cat > "$out/stats.json" <<END
{"system.cycles": {"value": $((latency * 10 + ways)), "unit": "cycles"},
 "system.dram.bytes_read": {"value": $((9999 / ways)), "unit": "bytes"}}
END
"""

SCHEMA = """{"properties": {
 "image": {"type": "object", "properties": {
  "width": {"type": "integer", "minimum": 1, "maximum": 16384, "default": 640}}},
 "ray_cache": {"type": "object", "properties": {
  "heuristic": {"type": "string", "default": "dir", "description": "Who shares a cell"},
  "cells": {"type": "integer", "minimum": 0, "maximum": 65536, "default": 0}}},
 "packet": {"type": "object", "properties": {
  "size": {"type": "integer", "minimum": 1, "maximum": 64, "default": 16}}},
 "packet_fifo": {"type": "object", "properties": {
  "depth": {"type": "integer", "minimum": 1, "maximum": 1000000, "default": 16}}},
 "l2": {"type": "object", "properties": {
  "mode": {"enum": ["normal", "perfect", "absent"], "default": "normal"},
  "ways": {"type": "integer", "minimum": 1, "maximum": 1024, "default": 8},
  "capacity": {"anyOf": [{"type": "integer", "minimum": 64, "maximum": 1099511627776},
   {"type": "string", "pattern": "^[0-9]+ ?([KMGT]iB|B)?$"}], "default": "512KiB"}}},
 "clock": {"type": "object", "properties": {
  "frequency": {"anyOf": [{"type": "number", "minimum": 1000, "maximum": 1e12},
   {"type": "string", "pattern": "^[0-9]+(\\\\.[0-9]+)?([eE][+-]?[0-9]+)? ?([kMGT]?Hz)?$"}],
   "default": "1GHz"}}},
 "render": {"type": "object", "properties": {
  "weight_cutoff": {"type": "number", "minimum": 0, "maximum": 1, "default": 0}}},
 "dram": {"type": "object", "properties": {
  "latency": {"type": "integer", "minimum": 1, "maximum": 1000000, "default": 100}}}}}
"""


@pytest.fixture
def stand_in(tmp_path: Path) -> Simulator:
    """A stand-in for the simulator in a folder of its own."""
    folder = tmp_path / "stand_in"
    folder.mkdir()
    (folder / "schema.json").write_text(SCHEMA)
    script = folder / "sheaf"
    script.write_text(STAND_IN)
    script.chmod(0o755)
    return Simulator(script)


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Keeps trees out of the user's cache."""
    os.environ["XDG_CACHE_HOME"] = str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(scope="session")
def sheaf() -> Path:
    """The simulator itself: $SHEAF or a build of this checkout."""
    names = ["tests", "release", "lead", "debug"]
    candidates = [os.environ.get("SHEAF"), *(CHECKOUT / f"build/{name}/sheaf" for name in names)]
    for candidate in candidates:
        if candidate and os.access(candidate, os.X_OK):
            return Path(candidate).resolve()
    pytest.skip("no simulator is built; set SHEAF")


@pytest.fixture
def tiny_scene(tmp_path: Path) -> Path:
    """A scene of a few triangles, so that a point takes milliseconds."""
    path = tmp_path / "tiny.gltf"
    path.write_text(tiny_gltf())
    return path


@pytest.fixture
def write_spec(tmp_path: Path) -> Callable[[str], Path]:
    """Writes a spec beside a scene file called scene.glb."""

    def write(text: str) -> Path:
        (tmp_path / "scene.glb").write_bytes(b"stand-in")
        path = tmp_path / "spec.toml"
        path.write_text(text)
        return path

    return write


@dataclass(frozen=True)
class Finished:
    """A command that has ended."""

    returncode: int
    stdout: str
    stderr: str


Explore = Callable[..., Finished]


@pytest.fixture
def explore() -> Explore:
    """Runs the explore command in this process, which saves a second of imports each time."""

    def run(*words: object) -> Finished:
        output, errors = io.StringIO(), io.StringIO()
        before = sys.argv
        sys.argv = ["explore", *map(str, words)]
        try:
            with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
                main()
            status = 0
        except SystemExit as end:
            status = int(end.code or 0)
        finally:
            sys.argv = before
        return Finished(status, output.getvalue(), errors.getvalue())

    return run
