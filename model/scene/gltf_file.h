// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sheaf::gltf {

using Bytes8 = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// A whole regular file of at most `limit` bytes.
[[nodiscard]] Bytes8 read_file(const std::filesystem::path& path, std::uint64_t limit);

/// The parts of a scene file: JSON text and, in a GLB, the binary chunk, if there is one.
struct Container {
  std::string_view json;
  std::optional<ByteView> binary;
};

/// Splits a scene file's bytes, which must outlive the result. Every length that a GLB states is
/// checked against the bytes that are there (glTF 2.0 specification, section 4.4, GLB layout).
[[nodiscard]] Container split_container(ByteView bytes);

}  // namespace sheaf::gltf
