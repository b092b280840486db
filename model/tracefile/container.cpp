// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/container.h"

#include <xxhash.h>

#include <stdexcept>

namespace sheaf {
namespace {

std::uint8_t nibble(char digit) {
  if (digit >= '0' && digit <= '9') return static_cast<std::uint8_t>(digit - '0');
  if (digit >= 'a' && digit <= 'f') return static_cast<std::uint8_t>(digit - 'a' + 10);
  throw std::logic_error("a hash has another digit than 0-9 and a-f");
}

}  // namespace

std::string to_hex(const Hash128& hash) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string digits;
  for (const std::uint8_t byte : hash) {
    digits += kDigits[byte >> 4];
    digits += kDigits[byte & 15];
  }
  return digits;
}

Hash128 hash_from_hex(const std::string& digits) {
  Hash128 hash{};
  if (digits.size() != 2 * hash.size()) throw std::logic_error("a hash has not 32 digits");
  for (std::size_t i = 0; i < hash.size(); ++i) {
    hash[i] = static_cast<std::uint8_t>(nibble(digits[2 * i]) << 4 | nibble(digits[2 * i + 1]));
  }
  return hash;
}

std::uint64_t checksum(ByteSpan bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

ByteVector encode_header(const TraceIdentity& identity) {
  ByteVector out(kTraceMagic.begin(), kTraceMagic.end());
  put_le(out, kTraceVersion);
  put_le(out, static_cast<std::uint32_t>(identity.kind));
  out.insert(out.end(), identity.scene_hash.begin(), identity.scene_hash.end());
  out.insert(out.end(), identity.config_hash.begin(), identity.config_hash.end());
  put_le(out, std::uint64_t{0});
  put_le(out, checksum(out, 0));
  return out;
}

// Seeding the sums with the offset tells a frame from its copy elsewhere.
ByteVector encode_frame_header(const TraceFrame& frame, ByteSpan stored) {
  ByteVector out;
  put_le(out, kFrameMagic);
  put_le(out, static_cast<std::uint32_t>(frame.type));
  put_le(out, frame.key);
  put_le(out, frame.num_records);
  put_le(out, frame.raw_bytes);
  put_le(out, frame.stored_bytes);
  put_le(out, std::uint32_t{0});
  put_le(out, checksum(stored, frame.offset));
  put_le(out, checksum(out, frame.offset));
  return out;
}

void encode_index_entry(const TraceFrame& frame, ByteVector& out) {
  put_le(out, frame.offset);
  put_le(out, frame.key);
  put_le(out, frame.num_records);
  put_le(out, frame.raw_bytes);
  put_le(out, frame.stored_bytes);
  put_le(out, static_cast<std::uint32_t>(frame.type));
}

ByteVector encode_trailer(const TraceTrailer& trailer) {
  ByteVector out;
  put_le(out, trailer.index_offset);
  put_le(out, trailer.num_frames);
  put_le(out, trailer.num_records);
  put_le(out, trailer.file_bytes);
  out.insert(out.end(), kTraceEndMagic.begin(), kTraceEndMagic.end());
  put_le(out, checksum(out, 0));
  return out;
}

}  // namespace sheaf
