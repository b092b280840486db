// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/ray.h"
#include "tracefile/byte_order.h"

namespace sheaf {

/// Ray traces are kept by square blocks of pixels, so that a reader finds a ray by its pixel.
inline constexpr std::uint32_t kBlockEdge = 16;

/// The blocks of a picture, row by row.
class BlockGrid {
 public:
  BlockGrid(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), columns_((width + kBlockEdge - 1) / kBlockEdge) {}
  [[nodiscard]] std::uint64_t num_blocks() const {
    return std::uint64_t{columns_} * ((height_ + kBlockEdge - 1) / kBlockEdge);
  }
  [[nodiscard]] std::uint64_t block_of(std::uint32_t pixel) const {
    return std::uint64_t{pixel / width_ / kBlockEdge} * columns_ + pixel % width_ / kBlockEdge;
  }
  /// Row × 16 + column within the block.
  [[nodiscard]] std::uint8_t position_of(std::uint32_t pixel) const {
    return static_cast<std::uint8_t>(pixel / width_ % kBlockEdge * kBlockEdge +
                                     pixel % width_ % kBlockEdge);
  }
  /// The pixel, or width × height if the block has none there.
  [[nodiscard]] std::uint32_t pixel_at(std::uint64_t block, std::uint8_t position) const {
    const std::uint64_t row = block / columns_ * kBlockEdge + position / kBlockEdge;
    const std::uint64_t column = block % columns_ * kBlockEdge + position % kBlockEdge;
    const bool inside = row < height_ && column < width_;
    return static_cast<std::uint32_t>(inside ? row * width_ + column
                                             : std::uint64_t{width_} * height_);
  }
  [[nodiscard]] std::uint32_t num_pixels_in(std::uint64_t block) const;

 private:
  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t columns_;
};

/// A ray that a hit spawned, into a slot as child_ray_id() counts them.
struct SpawnedRay {
  std::uint32_t slot = 0;
  Vec3 origin{0.0F};
  float t_max = 0.0F;
  Vec3 direction{0.0F};
  Vec3 weight{0.0F};
};

/// A ray that is no shadow ray, and what came of shading it. (Of a shadow ray nothing is spawned,
/// and it adds its weight to its pixel if it hit nothing.)
struct ShadedRay {
  RayTag tag;
  std::uint64_t packet = 0;  ///< in which it was shaded: number of that packet, from 0
  bool hit = false;
  bool contributes = false;       ///< it added something to its pixel
  std::uint32_t first_child = 0;  ///< of the block's children
  std::uint32_t num_children = 0;
};

/// Rays of one block of pixels in the order in which they were shaded.
struct RayBlock {
  std::vector<ShadedRay> rays;
  std::vector<SpawnedRay> children;

  void clear() {
    rays.clear();
    children.clear();
  }
  /// Roughly what it takes in memory.
  [[nodiscard]] std::size_t num_bytes() const {
    return rays.size() * sizeof(ShadedRay) + children.size() * sizeof(SpawnedRay);
  }
};

/// The content of a frame; traces/README.md describes it.
void encode_ray_block(const RayBlock& block, const BlockGrid& grid, ByteVector& raw);

/// The inverse, appended to `block`. Throws BadColumn for what is no frame of `num_rays` rays of
/// this block; what it accepts has only rays of pixels of the block, and children within range.
void decode_ray_block(ByteSpan raw, std::uint64_t number, std::uint32_t num_rays,
                      const BlockGrid& grid, RayBlock& block);

}  // namespace sheaf
