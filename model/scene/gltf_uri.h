// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/gltf_file.h"

namespace sheaf::gltf {

/// Fetches what a scene file's URIs name: base64 data, or files in the scene's own folder or below
/// it. Absolute paths, "..", other schemes and links that lead out of the folder are refused, and
/// so is more than kMaxBytes in all.
class UriReader {
 public:
  explicit UriReader(const std::filesystem::path& scene_file);

  /// `place` is where the URI stands, for messages.
  [[nodiscard]] Bytes8 read(const std::string& place, const std::string& uri);
  /// Refuses what read() would refuse, without reading.
  void check(const std::string& place, const std::string& uri) const;

 private:
  [[nodiscard]] std::filesystem::path resolve(const std::string& place,
                                              const std::string& uri) const;

  std::filesystem::path folder_;
  std::uint64_t remaining_;
};

}  // namespace sheaf::gltf
