#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the fuzz targets with clang and runs each for so many seconds (default 60). New inputs are
# gathered in build/fuzz/found/<target>; an input that crashes a target is left in build/fuzz and makes
# the exit code nonzero. Such an input belongs into tests/fuzz/corpus/<target>, with the cure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. .ci/prepare.sh

seconds="${1:-60}"
targets=(config gltf ray_trace text_trace)
install_packages .ci/packages-build.txt .ci/packages-fuzz.txt
say "Configuring build/fuzz"
quietly configure-fuzz cmake --preset fuzz
say "Building"
cmake --build --preset fuzz --parallel "$(parallel_jobs)" --target "${targets[@]/%/_fuzz}"

status=0
for target in "${targets[@]}"; do
  say "Fuzzing $target for $seconds s"
  mkdir -p "build/fuzz/found/$target"
  "build/fuzz/tests/fuzz/${target}_fuzz" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -max_len=65536 -print_final_stats=1 -verbosity=0 -artifact_prefix="build/fuzz/$target-" \
    "build/fuzz/found/$target" "tests/fuzz/corpus/$target" || status=1
done
exit "$status"
