// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/data_kind.h"
#include "base/units.h"

namespace sheaf {

/// How much of everything there is. What a scene does not need counts 0 and takes no room.
struct MemoryCounts {
  struct TextureSize {
    std::uint32_t width = 0;   ///< texels
    std::uint32_t height = 0;  ///< texels
  };
  std::uint64_t nodes = 0;
  std::uint64_t leaf_entries = 0;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t materials = 0;
  std::vector<TextureSize> textures;
  std::uint64_t pixels = 0;
  Bytes bytes_per_pixel = 0;
};

/// Where everything stands in the simulated machine's memory: one region per kind of data, in the
/// order of DataKind, the first at kBase, each on the first page that the regions before it leave
/// free. Spilled rays come last and have no size: they may take all that lies behind.
class MemoryMap {
 public:
  static constexpr Address kBase = 0x1000'0000;
  static constexpr Bytes kPage = 4096;
  static constexpr Bytes kNodeSize = 8;
  static constexpr Bytes kLeafEntrySize = 4;
  /// Nine floats and the numbers of the three vertices.
  static constexpr Bytes kTriangleSize = 48;
  static constexpr Bytes kTriangleIndicesOffset = 36;
  /// Normal (12), UV (8) and padding to a half cache line.
  static constexpr Bytes kVertexSize = 32;
  static constexpr Bytes kMaterialSize = 64;
  /// RGBA8. A block of 4 × 4 texels is one 64-byte line.
  static constexpr Bytes kTexelSize = 4;
  static constexpr std::uint32_t kBlockEdge = 4;
  static constexpr Bytes kBlockSize = kTexelSize * kBlockEdge * kBlockEdge;

  struct Region {
    Address base = 0;
    Bytes size = 0;
  };

  explicit MemoryMap(const MemoryCounts& counts);

  [[nodiscard]] const Region& region(DataKind kind) const {
    return regions_[static_cast<std::size_t>(kind)];
  }
  /// From kBase to behind the frame buffer.
  [[nodiscard]] Bytes total_size() const;

  // Indices must be below the counts that the map was made of.
  [[nodiscard]] Address node(std::uint64_t index) const {
    return region(DataKind::kNode).base + index * kNodeSize;
  }
  [[nodiscard]] Address leaf_entry(std::uint64_t index) const {
    return region(DataKind::kLeafList).base + index * kLeafEntrySize;
  }
  [[nodiscard]] Address triangle(std::uint64_t primitive) const {
    return region(DataKind::kTriangle).base + primitive * kTriangleSize;
  }
  [[nodiscard]] Address triangle_indices(std::uint64_t primitive) const {
    return triangle(primitive) + kTriangleIndicesOffset;
  }
  [[nodiscard]] Address vertex(std::uint64_t index) const {
    return region(DataKind::kAttribute).base + index * kVertexSize;
  }
  /// Materials stand behind the vertices, in the region of attributes.
  [[nodiscard]] Address material(std::uint64_t index) const {
    return first_material_ + index * kMaterialSize;
  }
  /// Texel (x, y) of a texture. Blocks stand row by row, texels row by row in their block; edge
  /// blocks are padded.
  [[nodiscard]] Address texel(std::size_t texture, std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] Address pixel(std::uint64_t index) const {
    return region(DataKind::kPixel).base + index * bytes_per_pixel_;
  }

 private:
  struct TextureLayout {
    Address base = 0;
    std::uint64_t blocks_per_row = 0;
  };
  Bytes lay_textures(const MemoryCounts& counts);

  std::array<Region, kNumDataKinds> regions_;
  std::vector<TextureLayout> textures_;
  Address first_material_ = 0;
  Bytes bytes_per_pixel_ = 0;
};

}  // namespace sheaf
