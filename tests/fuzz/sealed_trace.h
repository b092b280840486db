// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "tracefile/trace_writer.h"

namespace sheaf::test {

/// The key of a frame from a byte of the input and the number of records that came before it in
/// frames of the same byte.
using FrameKey = std::function<std::uint64_t(std::uint8_t, std::uint64_t)>;

/// Checksums keep a fuzzer from metadata and frames, so that an input is these, and a trace with
/// right checksums is made of them. JSON up to the first zero byte, then frames: the number of
/// records (16 bits, little endian), a byte for the key, the size of the content (16 bits), and the
/// content, cut off where the input ends.
inline void seal_trace(const std::filesystem::path& path, TraceKind kind, ByteSpan input,
                       const FrameKey& key_of) {
  const auto zero = std::find(input.begin(), input.end(), 0);
  const std::string metadata(input.begin(), zero);
  ByteSpan left = input.subspan(metadata.size());
  if (!left.empty()) left = left.subspan(1);
  const auto number = [&left](std::size_t at) { return left[at] + 256U * left[at + 1]; };
  TraceWriter writer(path, {kind, {}, {}});
  std::array<std::uint64_t, 256> records_before{};
  constexpr std::size_t kHeader = 5;
  while (left.size() > kHeader) {
    const std::uint32_t num_records = number(0);
    const std::uint8_t key = left[2];
    const std::size_t size = std::min<std::size_t>(number(3), left.size() - kHeader);
    const ByteSpan content = left.subspan(kHeader, size);
    writer.add(key_of(key, records_before[key]), num_records,
               [bytes = ByteVector(content.begin(), content.end())] { return bytes; });
    records_before[key] += num_records;
    left = left.subspan(kHeader + size);
  }
  writer.finish(metadata);
}

}  // namespace sheaf::test
