// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "geometry/box.h"
#include "geometry/vec.h"

namespace sheaf {

/// Which sorting heuristic: as written in the paper's tables none, dir, mdir(96), fastpos,
/// pos(1.0), opos; and from its field ray5d(2) and grid(8).
struct HeuristicChoice {
  enum class Kind : std::uint8_t { kNone, kDir, kMdir, kFastpos, kPos, kOpos, kRay5d, kGrid };
  Kind kind = Kind::kDir;
  /// mdir: number of cells, 6 k²; pos: squared distance in scene units; ray5d: levels of its tree;
  /// grid: voxels along each axis.
  double x = 0.0;

  /// Throws Error(kUsage) with the rule that the text breaks.
  [[nodiscard]] static HeuristicChoice parse(std::string_view text);
  [[nodiscard]] std::string to_string() const;
  /// Cells that serve every key (dir, fastpos: 8, mdir(x): x, none: 1); at most 192 for ray5d; 64
  /// for pos and grid, which have no keys.
  [[nodiscard]] std::uint32_t natural_cells() const;
};

inline constexpr std::uint32_t kNoCell = ~std::uint32_t{0};

/// Maps rays to the open cells of a ray cache. Knows which cells are open because it is told.
class Heuristic {
 public:
  virtual ~Heuristic() = default;
  /// The open cell in which the ray belongs, or kNoCell if one must be opened for it.
  [[nodiscard]] virtual std::uint32_t find(const Vec3& origin, const Vec3& direction) const = 0;
  /// A cell has been opened with this ray as its first.
  virtual void open(std::uint32_t cell, const Vec3& origin, const Vec3& direction) = 0;
  virtual void close(std::uint32_t cell) = 0;
};

/// For every kind but opos and grid, which use no cells; `none` is packets in order of arrival.
/// `num_cells`: cells of the ray cache.
[[nodiscard]] std::unique_ptr<Heuristic> make_heuristic(const HeuristicChoice& choice,
                                                        std::uint32_t num_cells,
                                                        const Box& scene_bounds);

}  // namespace sheaf
