// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/ray_block.h"

#include <algorithm>
#include <bit>

#include "tracefile/columns.h"

namespace sheaf {
namespace {

// The byte of flags.
constexpr std::uint8_t kKindMask = 3;
constexpr std::uint8_t kHitFlag = 4;
constexpr std::uint8_t kContributesFlag = 8;

constexpr std::size_t kNumWords = 10;
constexpr std::size_t kLeastChildBytes = 1 + 4 * kNumWords;  ///< with a slot of one byte

/// The i-th word of a spawned ray: origin, direction, t_max, weight.
const float& word_of(const SpawnedRay& ray, std::size_t i) {
  if (i < 3) return ray.origin[static_cast<int>(i)];
  if (i < 6) return ray.direction[static_cast<int>(i - 3)];
  return i == 6 ? ray.t_max : ray.weight[static_cast<int>(i - 7)];
}

float& word_of(SpawnedRay& ray, std::size_t i) {
  return const_cast<float&>(word_of(static_cast<const SpawnedRay&>(ray), i));
}

std::uint8_t flags_of(const ShadedRay& ray) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(ray.tag.kind) | (ray.hit ? kHitFlag : 0U) |
                                   (ray.contributes ? kContributesFlag : 0U));
}

}  // namespace

std::uint32_t BlockGrid::num_pixels_in(std::uint64_t block) const {
  const auto row = static_cast<std::uint32_t>(block / columns_ * kBlockEdge);
  const auto column = static_cast<std::uint32_t>(block % columns_ * kBlockEdge);
  return std::min(kBlockEdge, height_ - row) * std::min(kBlockEdge, width_ - column);
}

void encode_ray_block(const RayBlock& block, const BlockGrid& grid, ByteVector& raw) {
  raw.clear();
  ColumnWriter columns(raw);
  std::vector<std::uint8_t> positions;
  std::vector<std::uint8_t> flags;
  std::vector<std::uint8_t> depths;
  std::vector<std::uint64_t> ids;
  NumberColumn packets;
  NumberColumn counts;
  std::uint64_t last_packet = 0;
  for (const ShadedRay& ray : block.rays) {
    positions.push_back(grid.position_of(ray.tag.pixel));
    flags.push_back(flags_of(ray));
    depths.push_back(ray.tag.depth);
    if (ray.tag.kind != RayKind::kPrimary) ids.push_back(ray.tag.id);
    packets.put(zigzag(static_cast<std::int64_t>(ray.packet - last_packet)));
    last_packet = ray.packet;
    counts.put(ray.num_children);
  }
  columns.bytes(positions);
  columns.bytes(flags);
  columns.bytes(depths);
  columns.longs(ids);
  columns.numbers(packets);
  columns.numbers(counts);
  NumberColumn slots;
  for (const SpawnedRay& child : block.children) slots.put(child.slot);
  columns.numbers(slots);
  std::vector<std::uint32_t> words(block.children.size());
  for (std::size_t i = 0; i < kNumWords; ++i) {
    for (std::size_t child = 0; child < words.size(); ++child) {
      words[child] = std::bit_cast<std::uint32_t>(word_of(block.children[child], i));
    }
    columns.words(words);
  }
}

void decode_ray_block(ByteSpan raw, std::uint64_t number, std::uint32_t num_rays,
                      const BlockGrid& grid, RayBlock& block) {
  ColumnReader columns(raw);
  std::vector<std::uint8_t> positions;
  std::vector<std::uint8_t> flags;
  std::vector<std::uint8_t> depths;
  columns.bytes(num_rays, positions);
  columns.bytes(num_rays, flags);
  columns.bytes(num_rays, depths);
  const auto is_primary = [](std::uint8_t flag) {
    return static_cast<RayKind>(flag & kKindMask) == RayKind::kPrimary;
  };
  const auto num_primary = static_cast<std::size_t>(std::ranges::count_if(flags, is_primary));
  std::vector<std::uint64_t> ids;
  std::vector<std::uint64_t> packets;
  std::vector<std::uint64_t> counts;
  columns.longs(num_rays - num_primary, ids);
  columns.varints(num_rays, packets);
  columns.varints(num_rays, counts);
  std::uint64_t packet = 0;
  std::uint64_t num_children = 0;
  std::size_t next_id = 0;
  const auto first_child = static_cast<std::uint32_t>(block.children.size());
  for (std::uint32_t i = 0; i < num_rays; ++i) {
    ShadedRay ray;
    ray.tag.pixel = grid.pixel_at(number, positions[i]);
    if (grid.block_of(ray.tag.pixel) != number) throw BadColumn("a ray has no pixel");
    if (flags[i] >= 2 * kContributesFlag || (flags[i] & kKindMask) == 3) {
      throw BadColumn("a ray has unknown flags");
    }
    ray.tag.kind = static_cast<RayKind>(flags[i] & kKindMask);
    ray.tag.depth = depths[i];
    ray.tag.id = is_primary(flags[i]) ? primary_ray_id(ray.tag.pixel) : ids[next_id++];
    ray.hit = (flags[i] & kHitFlag) != 0;
    ray.contributes = (flags[i] & kContributesFlag) != 0;
    packet += static_cast<std::uint64_t>(unzigzag(packets[i]));
    ray.packet = packet;
    if (counts[i] > raw.size() / kLeastChildBytes - num_children) {
      throw BadColumn("a ray has too many children");
    }
    ray.first_child = first_child + static_cast<std::uint32_t>(num_children);
    ray.num_children = static_cast<std::uint32_t>(counts[i]);
    num_children += counts[i];
    block.rays.push_back(ray);
  }
  std::vector<std::uint64_t> slots;
  columns.varints(num_children, slots);
  block.children.resize(first_child + num_children);
  for (std::size_t i = 0; i < num_children; ++i) {
    if (slots[i] > 0xFFFFFFFF) throw BadColumn("a slot has more than 32 bits");
    block.children[first_child + i].slot = static_cast<std::uint32_t>(slots[i]);
  }
  std::vector<std::uint32_t> words;
  for (std::size_t word = 0; word < kNumWords; ++word) {
    columns.words(num_children, words);
    for (std::size_t i = 0; i < num_children; ++i) {
      word_of(block.children[first_child + i], word) = std::bit_cast<float>(words[i]);
    }
  }
  columns.finish();
}

}  // namespace sheaf
