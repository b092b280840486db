# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Sums up JUnit reports, of CTest and pytest alike: "N passed, N failed", the skipped above it."""

import sys
import xml.etree.ElementTree as ElementTree


def count(path: str, number: str) -> int:
    """A number such as tests, failures or skipped, over all suites of one report."""
    suites = ElementTree.parse(path).getroot().iter("testsuite")
    return sum(int(suite.get(number, 0)) for suite in suites)


reports = sys.argv[1:]
total, skipped = (sum(count(path, number) for path in reports) for number in ("tests", "skipped"))
failed = sum(count(path, "failures") + count(path, "errors") for path in reports)
if skipped:
    print(f"{skipped} skipped")
print(f"{total - skipped - failed} passed, {failed} failed")
