#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
#
# run.sh [SECONDS [SEED [TARGET]]]: builds the fuzz targets with clang and runs each, or one, for so many
# seconds (60) from a seed (1); run-tests does so with both as they are. What a run finds is left in
# build/fuzz/tests/fuzz/found/TARGET/corpus; what of it reaches code that the committed corpus does not:
#     build/fuzz/tests/fuzz/TARGET_fuzz -set_cover_merge=1 tests/fuzz/corpus/TARGET \
#         build/fuzz/tests/fuzz/found/TARGET/corpus
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. .ci/prepare.sh

install_packages .ci/packages-build.txt .ci/packages-fuzz.txt
build_preset fuzz
export SHEAF_FUZZ_SECONDS="${1:-60}" SHEAF_FUZZ_SEED="${2:-1}"
ctest --test-dir build/fuzz --parallel "$(nproc)" --output-on-failure --no-tests=error -R "Fuzz\.${3:-}"
