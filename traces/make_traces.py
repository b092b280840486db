#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Records the traces in this folder, bit for bit: traces/make_traces.py build/release/sheaf [OUT]"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SMALL = ("image.width=48", "image.height=36")
RUNS = (
    ("sponza", ("rays", "memory"), (*SMALL, "render.recursion_level=2")),
    ("dragon", ("memory",), (*SMALL, "flow.control=credits", "ray_cache.heuristic=none")),
)


def main():
    sheaf = pathlib.Path(sys.argv[1]).resolve()
    out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "traces").resolve()
    with tempfile.TemporaryDirectory() as scratch:
        for scene, kinds, settings in RUNS:
            words = [word for setting in settings for word in ("--set", setting)]
            words += [word for kind in kinds for word in ("--record", kind)]
            # From the root, since the trace names the scene as it was given.
            subprocess.run([sheaf, "run", f"scenes/{scene}.glb", *words, "--quiet", "--out",
                            scratch], check=True, cwd=ROOT)
            for kind in kinds:
                shutil.copyfile(f"{scratch}/{kind}.trace", out / f"{scene}-{kind}.trace")


if __name__ == "__main__":
    main()
