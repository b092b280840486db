#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Puts generated tables into rtl_notes/stability.md, each between its markers:

    build/release/sheaf stability --out result/stability
    tests/stress/document.py catalogue result/stability/stability.md
    tests/stress/mutate.py > build/mutations.md
    tests/stress/document.py mutations build/mutations.md
    tests/stress/models_table.py build/release/sheaf /usr/share/assimp/models > build/models.md
    tests/stress/document.py models build/models.md"""

import pathlib
import sys

PAGE = pathlib.Path(__file__).resolve().parents[2] / "rtl_notes" / "stability.md"


def main() -> int:
    name, table = sys.argv[1:]
    begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
    text = PAGE.read_text()
    head, rest = text.split(begin)
    tail = rest.split(end)[1]
    PAGE.write_text(f"{head}{begin}\n\n{pathlib.Path(table).read_text().strip()}\n\n{end}{tail}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
