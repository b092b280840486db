// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <system_error>

#include "scene/gltf_limits.h"
#include "scene/gltf_refusal.h"

namespace sheaf::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF data is read without swapping");

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word(ByteView bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string_view as_text(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void check_header(ByteView bytes) {
  if (bytes.size() < kHeaderBytes) {
    refuse("", fmt::format("GLB header truncated at byte {}; export the file again", bytes.size()));
  }
  if (word(bytes, 4) != 2) {
    refuse("", fmt::format("GLB version {} is not supported; convert the file to glTF 2.0",
                           word(bytes, 4)));
  }
  if (word(bytes, 8) > bytes.size()) {
    refuse("", fmt::format("truncated GLB: {} of {} bytes are there; copy or export the file again",
                           bytes.size(), word(bytes, 8)));
  }
  if (word(bytes, 8) < bytes.size()) {
    refuse("", fmt::format("the GLB header states {} bytes, the file has {}; export it again",
                           word(bytes, 8), bytes.size()));
  }
}

/// The chunk at `offset`, which is moved behind it.
ByteView take_chunk(ByteView bytes, std::size_t& offset, std::uint32_t& type) {
  const std::size_t rest = bytes.size() - offset;
  if (rest < kChunkHeaderBytes || word(bytes, offset) > rest - kChunkHeaderBytes) {
    refuse("", fmt::format("the GLB chunk at byte {} runs past the end; export the file again",
                           offset));
  }
  const std::size_t length = word(bytes, offset);
  type = word(bytes, offset + 4);
  const ByteView chunk = bytes.subspan(offset + kChunkHeaderBytes, length);
  offset += kChunkHeaderBytes + length;
  return chunk;
}

Container split_glb(ByteView bytes) {
  check_header(bytes);
  Container result;
  std::size_t offset = kHeaderBytes;
  std::uint32_t type = 0;
  result.json = as_text(take_chunk(bytes, offset, type));
  if (type != kJsonChunk) {
    refuse("", "the first GLB chunk is not JSON; export the file again");
  }
  // Only the second chunk may be the binary one; others belong to extensions and are skipped.
  for (bool second = true; offset < bytes.size(); second = false) {
    const ByteView chunk = take_chunk(bytes, offset, type);
    if (second && type == kBinaryChunk) result.binary = chunk;
  }
  return result;
}

}  // namespace

Bytes8 read_file(const std::filesystem::path& path, std::uint64_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse("", "no such file");
  if (std::filesystem::is_directory(status)) refuse("", "is a folder, not a glTF file");
  if (!std::filesystem::is_regular_file(status)) refuse("", "is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse("", "cannot be read: " + error.message());
  if (size > limit) refuse("", fmt::format("{} bytes are more than the {} allowed", size, limit));
  Bytes8 bytes(size);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse("", "cannot be opened; check its permissions");
  if (size > 0 &&
      !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    refuse("", "cannot be read to its end");
  }
  return bytes;
}

Container split_container(ByteView bytes) {
  if (bytes.empty()) refuse("", "is empty, not a glTF file");
  if (bytes.size() >= 4 && word(bytes, 0) == kMagic) return split_glb(bytes);
  std::string_view text = as_text(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || text[start] != '{') {
    refuse("", "not a glTF file: neither the GLB magic nor a JSON object at its start");
  }
  return {text, std::nullopt};
}

}  // namespace sheaf::gltf
