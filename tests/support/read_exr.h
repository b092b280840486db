// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sheaf::test {

struct ExrImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::map<std::string, std::vector<float>> channels;  ///< row by row from the top
  std::map<std::string, std::string> texts;            ///< attributes of the header
};

/// Reads an OpenEXR file with OpenEXR; throws what OpenEXR throws.
[[nodiscard]] ExrImage read_exr(const std::filesystem::path& path);

}  // namespace sheaf::test
