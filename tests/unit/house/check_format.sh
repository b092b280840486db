#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
#
# Fails if clang-format would change a source file, and names those files. Exit code 77: skipped,
# because another release of clang-format than the one the project is formatted with (Debian 12's)
# may lay out code differently.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."

if ! clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
  echo "clang-format 14 is not installed: formatting is not checked"
  exit 77
fi
status=0
complaints=$(find model tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format --dry-run -Werror 2>&1) || status=1
if [ "$status" -ne 0 ]; then
  echo "clang-format -i would change:"
  sed -n 's/^\([^: ]*\):[0-9]*:[0-9]*: error:.*/  \1/p' <<<"$complaints" | sort -u
fi
exit "$status"
