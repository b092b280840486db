#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the committed scenes, or checks that they are what the recipes make."""

from __future__ import annotations

import argparse
import hashlib
import sys
from collections.abc import Callable
from pathlib import Path

from recipes import dragon, fairy, newtree, oldtree, sponza, stanford
from recipes.glb import GlbWriter

RECIPES: dict[str, Callable[[], GlbWriter]] = {
    "dragon": dragon.build,
    "fairy": fairy.build,
    "newtree": newtree.build,
    "oldtree": oldtree.build,
    "sponza": sponza.build,
}


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"some of {', '.join(RECIPES)}")
    parser.add_argument("--check", action="store_true", help="write nothing, compare bytes")
    parser.add_argument(
        "--stanford",
        type=Path,
        metavar="PLY",
        help="make result/dragon_stanford.glb with the real dragon of this file instead",
    )
    arguments = parser.parse_args()
    for name in arguments.scenes:
        if name not in RECIPES:
            parser.error(f"no scene '{name}', only {', '.join(RECIPES)}")
    return arguments


def make_stanford(model: Path, folder: Path) -> int:
    """The scene `dragon` with the real one, which is no part of the project."""
    try:
        scene = stanford.build(model)
    except (OSError, ValueError, KeyError, StopIteration) as problem:
        print(f"error: {model}: {problem or 'ends too soon'}", file=sys.stderr)
        return 1
    path = folder / "dragon_stanford.glb"
    folder.mkdir(exist_ok=True)
    path.write_bytes(scene.to_bytes())
    print(f"{path}: {scene.triangles} triangles")
    return 0


def main() -> int:
    arguments = parse_arguments()
    folder = Path(__file__).resolve().parent
    if arguments.stanford:
        return make_stanford(arguments.stanford, folder.parent / "result")
    wrong = []
    for name in arguments.scenes or RECIPES:
        scene = RECIPES[name]()
        data = scene.to_bytes()
        path = folder / f"{name}.glb"
        if not arguments.check:
            path.write_bytes(data)
        elif not path.is_file() or path.read_bytes() != data:
            wrong.append(path.name)
        digest = hashlib.sha256(data).hexdigest()
        print(f"{digest}  {path.name}  {scene.triangles} triangles  {len(data)} bytes", flush=True)
    if wrong:
        print(f"error: {', '.join(wrong)}: not what the recipe makes", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
