// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tracefile/byte_order.h"

namespace sheaf {

// The container that both kinds of trace share; traces/README.md describes it byte by byte.

enum class TraceKind : std::uint32_t { kRays = 1, kMemory = 2 };
[[nodiscard]] constexpr const char* to_string(TraceKind kind) {
  return kind == TraceKind::kRays ? "rays" : "memory";
}

using Hash128 = std::array<std::uint8_t, 16>;
/// 32 hexadecimal digits.
[[nodiscard]] std::string to_hex(const Hash128& hash);
/// The inverse; throws std::logic_error for anything but 32 hexadecimal digits.
[[nodiscard]] Hash128 hash_from_hex(const std::string& digits);

/// What a trace says about itself at its beginning.
struct TraceIdentity {
  TraceKind kind = TraceKind::kRays;
  Hash128 scene_hash{};   ///< of what the rays met (scene_hash.h)
  Hash128 config_hash{};  ///< of the recording configuration (config_hash)
};

enum class FrameType : std::uint32_t { kData = 1, kMetadata = 2, kIndex = 3 };

/// One independently compressed piece of a trace.
struct TraceFrame {
  std::uint64_t offset = 0;  ///< of its header in the file
  FrameType type = FrameType::kData;
  std::uint64_t key = 0;  ///< rays: the block of pixels; memory: number of the first access
  std::uint32_t num_records = 0;
  std::uint32_t raw_bytes = 0;     ///< before compression
  std::uint32_t stored_bytes = 0;  ///< after it
};

inline constexpr std::array<std::uint8_t, 8> kTraceMagic{0x89, 'S', 'H', 'E', 'A', 'F', '\r', '\n'};
inline constexpr std::array<std::uint8_t, 8> kTraceEndMagic{'S', 'H', 'E', 'A', 'F', 'E', 'N', 'D'};
inline constexpr std::uint32_t kTraceVersion = 1;
inline constexpr std::uint32_t kFrameMagic = 0x4d415246;  // "FRAM"
inline constexpr std::size_t kTraceHeaderBytes = 64;
inline constexpr std::size_t kFrameHeaderBytes = 48;
inline constexpr std::size_t kIndexEntryBytes = 32;
inline constexpr std::size_t kTraceTrailerBytes = 48;
/// A data or metadata frame is no larger than this when it is unpacked.
inline constexpr std::uint32_t kMaxFrameBytes = 1U << 24;

[[nodiscard]] ByteVector encode_header(const TraceIdentity& identity);
/// The header of a frame that will stand at frame.offset and hold `stored`.
[[nodiscard]] ByteVector encode_frame_header(const TraceFrame& frame, ByteSpan stored);
void encode_index_entry(const TraceFrame& frame, ByteVector& out);

struct TraceTrailer {
  std::uint64_t index_offset = 0;
  std::uint64_t num_frames = 0;   ///< data and metadata
  std::uint64_t num_records = 0;  ///< in all data frames
  std::uint64_t file_bytes = 0;
};
[[nodiscard]] ByteVector encode_trailer(const TraceTrailer& trailer);

/// XXH3, 64 bits.
[[nodiscard]] std::uint64_t checksum(ByteSpan bytes, std::uint64_t seed);

}  // namespace sheaf
