#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
#
# fuzz_one.sh BINARY CORPUS: fuzzes one target for SHEAF_FUZZ_SECONDS (60) from SHEAF_FUZZ_SEED (1). It begins
# with the committed corpus alone, so that the seed says which inputs are tried, and in which order; TARGET.dict
# beside this script, if there is one, has what inputs are made of. An input that the target does not survive is
# printed, with how to repeat it.
set -uo pipefail
binary=$1 corpus=$2
target=$(basename "$corpus")
work=$(dirname "$binary")/found/$target
rm -rf "$work"
mkdir -p "$work/corpus"
dictionary=$(dirname "$0")/$target.dict
options=()
if [ -f "$dictionary" ]; then options=("-dict=$dictionary"); fi
symbolizer=$(command -v llvm-symbolizer-16 || true)
export ASAN_SYMBOLIZER_PATH=$symbolizer UBSAN_SYMBOLIZER_PATH=$symbolizer

"$binary" "${options[@]}" -seed="${SHEAF_FUZZ_SEED:-1}" -max_total_time="${SHEAF_FUZZ_SECONDS:-60}" -timeout=30 \
  -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 -print_funcs=0 -verbosity=0 \
  -artifact_prefix="$work/" "$work/corpus" "$corpus" && exit 0

for input in "$work"/*-*; do
  [ -f "$input" ] || continue
  name=tests/fuzz/corpus/$target/$(basename "$input")
  printf '\nTo repeat it, with clang or without:\n  base64 -d <<END >%s\n%s\nEND\n' "$name" "$(base64 "$input")"
  printf '  tests/fuzz/run.sh 1 || ctest --test-dir build/tests -R FuzzCorpus.%s\n' "$target"
  printf 'The input stays there, as a test, with the cure.\n'
done
exit 1
