// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "image/rows.h"

namespace sheaf {

/// One channel of an EXR file: "R", "albedo.G", "depth.Z", "heat.<counter>.Y" and so on.
struct ExrChannel {
  std::string name;
  RowSource<float> rows;
};

/// One line of text in the file's header.
struct ExrAttribute {
  std::string name;
  std::string value;
};

/// Writes an OpenEXR file of 32-bit float scan lines, ZIP-compressed, band by band. The same input
/// gives the same bytes: no time stamp, no dependence on threads or on the order of channels.
/// Throws Error(kOutput, "<path>: <reason>") if it cannot be written, std::logic_error if a
/// channel's name comes twice, and Iex exceptions for a header that OpenEXR refuses.
void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const ExrChannel> channels, std::span<const ExrAttribute> attributes);

}  // namespace sheaf
