#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""What `sheaf info` says to every glTF file below some folders, as a Markdown table.

    tests/stress/models_table.py build/release/sheaf /usr/share/assimp/models

Debian's package assimp-testmodels brings Khronos models and broken files. The exit code is 0 just when
every file was either loaded or refused with one line (exit code 3)."""

import pathlib
import subprocess
import sys


def verdict(command: str, file: pathlib.Path) -> tuple:
    """("loads" | "refused" | "BAD", what was said)."""
    done = subprocess.run([command, "info", file], capture_output=True, text=True, timeout=60)
    lines = [line.removeprefix("sheaf: ").replace(f"{file}: ", "")
             for line in done.stderr.splitlines()]
    if done.returncode == 0:
        return "loads", "; ".join(line.removeprefix("note: ") for line in lines)
    if done.returncode == 3 and len(lines) == 1:
        return "refused", lines[0]
    return "BAD", f"exit code {done.returncode}: {' '.join(lines)}"


def main() -> int:
    command, *folders = sys.argv[1:]
    print("| file | verdict | said |\n| --- | --- | --- |")
    bad = 0
    for folder in map(pathlib.Path, folders):
        for file in sorted(f for f in folder.rglob("*.gl*") if f.suffix in (".gltf", ".glb")):
            word, said = verdict(command, file)
            bad += word == "BAD"
            print(f"| {file.relative_to(folder)} | {word} | {said.replace('|', chr(92) + '|')} |")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
