// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sheaf {

/// One channel of an EXR file: "R", "albedo.G", "depth.Z", "heat.<counter>.Y" and so on.
struct ExrChannel {
  std::string name;
  std::span<const float> pixels;  ///< width × height, row by row from the top
};

/// One line of text in the file's header.
struct ExrAttribute {
  std::string name;
  std::string value;
};

/// An OpenEXR file of 32-bit float scan lines, ZIP-compressed. The same input gives the same bytes:
/// no time stamp, no dependence on threads or on the order of channels. Throws std::logic_error if
/// a channel's size is not width × height or a channel's name comes twice, and Iex exceptions for a
/// header that OpenEXR refuses.
[[nodiscard]] std::vector<std::uint8_t> encode_exr(std::uint32_t width, std::uint32_t height,
                                                   std::span<const ExrChannel> channels,
                                                   std::span<const ExrAttribute> attributes);

/// The same into a file. Throws Error(kOutput, "<path>: <reason>") if it cannot be written.
void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const ExrChannel> channels, std::span<const ExrAttribute> attributes);

}  // namespace sheaf
