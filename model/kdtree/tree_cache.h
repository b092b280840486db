// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>

#include "kdtree/build.h"

namespace sheaf {

/// A folder in which kd-trees outlive the process that built them, so that the many runs of a sweep
/// build each tree once. A file is named by the hash of all that the tree depends on, carries a
/// checksum, and appears whole or not at all, whoever else writes the same one. The files used
/// longest ago are removed when all of them together exceed the limit.
///
/// The folder only ever saves time: what is missing, damaged or of another version is built anew,
/// and a folder that cannot be written is left alone.
class TreeCache {
 public:
  static constexpr std::uintmax_t kDefaultLimit = std::uintmax_t{1} << 30U;

  /// `limit`: bytes of all files together.
  explicit TreeCache(std::filesystem::path folder, std::uintmax_t limit = kDefaultLimit)
      : folder_(std::move(folder)), limit_(limit) {}

  /// sheaf in $XDG_CACHE_HOME, else in .cache of the home folder; none if neither is known.
  [[nodiscard]] static std::optional<std::filesystem::path> default_folder();

  /// The tree that build_kd_tree() gives, and throws as that does.
  [[nodiscard]] KdTree get(std::span<const Vec3> positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const KdBuildOptions& options) const;

  /// Where that tree is kept.
  [[nodiscard]] std::filesystem::path file_of(
      std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
      const KdBuildOptions& options) const;

 private:
  void keep(const KdTree& tree, const std::filesystem::path& file) const;
  void make_room() const;

  std::filesystem::path folder_;
  std::uintmax_t limit_;
};

/// A tree as bytes, and back; none if the rest of `file` is not such a tree over `num_triangles`
/// triangles.
[[nodiscard]] std::string to_bytes(const KdTree& tree);
[[nodiscard]] std::optional<KdTree> read_tree(std::istream& file, std::uint64_t num_triangles);

}  // namespace sheaf
