// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/memory_map.h"

namespace sheaf {
namespace {

constexpr std::uint64_t divide_up(std::uint64_t value, std::uint64_t unit) {
  return (value + unit - 1) / unit;
}

constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t unit) {
  return divide_up(value, unit) * unit;
}

}  // namespace

MemoryMap::MemoryMap(const MemoryCounts& counts) : bytes_per_pixel_(counts.bytes_per_pixel) {
  const Bytes vertex_bytes = align_up(counts.vertices * kVertexSize, kMaterialSize);
  const std::array<Bytes, kNumDataKinds> sizes{counts.nodes * kNodeSize,
                                               counts.leaf_entries * kLeafEntrySize,
                                               counts.triangles * kTriangleSize,
                                               vertex_bytes + counts.materials * kMaterialSize,
                                               lay_textures(counts),
                                               counts.pixels * counts.bytes_per_pixel,
                                               0};
  Address next = kBase;
  for (std::size_t kind = 0; kind < kNumDataKinds; ++kind) {
    regions_[kind] = {next, sizes[kind]};
    next = align_up(next + sizes[kind], kPage);
  }
  first_material_ = region(DataKind::kAttribute).base + vertex_bytes;
  for (TextureLayout& texture : textures_) texture.base += region(DataKind::kTexture).base;
}

// Places the textures one behind the other from 0; returns the bytes they take.
Bytes MemoryMap::lay_textures(const MemoryCounts& counts) {
  Bytes size = 0;
  for (const auto& [width, height] : counts.textures) {
    const std::uint64_t columns = divide_up(width, kBlockEdge);
    textures_.push_back({size, columns});
    size += columns * divide_up(height, kBlockEdge) * kBlockSize;
  }
  return size;
}

Bytes MemoryMap::total_size() const {
  const Region& last = region(DataKind::kPixel);
  return last.base + last.size - kBase;
}

Address MemoryMap::texel(std::size_t texture, std::uint32_t x, std::uint32_t y) const {
  const TextureLayout& layout = textures_[texture];
  const std::uint64_t block = (y / kBlockEdge) * layout.blocks_per_row + x / kBlockEdge;
  const std::uint64_t inside = (y % kBlockEdge) * kBlockEdge + x % kBlockEdge;
  return layout.base + block * kBlockSize + inside * kTexelSize;
}

}  // namespace sheaf
