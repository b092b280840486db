// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/ray_recorder.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

namespace sheaf {
namespace {

// What may wait for its block to be finished. Unpacked, the largest block stays below a frame's
// limit: it is written as soon as it holds an eighth of this.
constexpr std::size_t kMaxOpenBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxBlockBytes = kMaxOpenBytes / 8;

}  // namespace

void RayRecorder::shade(const RayPacket& packet, PacketShading& out) {
  inner_.shade(packet, out);
  record(packet, out);
  ++num_packets_;
  while (open_bytes_ > kMaxOpenBytes) write_largest();
}

// The bundle is ordered by kind and then by lane; the trace wants a ray's children together.
void RayRecorder::order_children(const SpawnBundle& spawned) {
  first_child_.fill(0);
  for (const std::uint8_t lane : spawned.lanes) ++first_child_[lane + std::size_t{1}];
  for (std::size_t lane = 0; lane < kMaxPacketSize; ++lane) {
    first_child_[lane + 1] += first_child_[lane];
  }
  std::array<std::uint32_t, kMaxPacketSize> next{};
  std::copy_n(first_child_.begin(), next.size(), next.begin());
  children_.resize(spawned.rays.size());
  const std::size_t first_light_group = spawned.group_begins.size() - num_lights_;
  std::size_t group = 0;
  for (std::size_t i = 0; i < spawned.rays.size(); ++i) {
    while (group + 1 < spawned.group_begins.size() && spawned.group_begins[group + 1] <= i) ++group;
    const Ray& ray = spawned.rays[i];
    SpawnedRay& child = children_[next[spawned.lanes[i]]++];
    child = {static_cast<std::uint32_t>(ray.tag.kind == RayKind::kReflection ? 0
                                        : ray.tag.kind == RayKind::kRefraction
                                            ? 1
                                            : 2 + group - first_light_group),
             ray.origin, ray.t_max, ray.direction, ray.weight};
  }
}

RayRecorder::OpenBlock& RayRecorder::open(std::uint64_t number) {
  const auto [at, is_new] = open_.try_emplace(number);
  if (is_new) at->second.num_live = grid_.num_pixels_in(number);
  return at->second;
}

void RayRecorder::record(const RayPacket& packet, const PacketShading& shading) {
  order_children(shading.spawned);
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const std::uint64_t number = grid_.block_of(packet.tag[lane].pixel);
    OpenBlock& block = open(number);
    const std::uint32_t begin = first_child_[lane];
    const std::uint32_t count = first_child_[lane + 1] - begin;
    block.num_live += count;
    --block.num_live;
    if (packet.tag[lane].kind != RayKind::kShadow) {
      RayBlock& content = block.content;
      open_bytes_ -= content.num_bytes();
      content.rays.push_back({packet.tag[lane], num_packets_, packet.hit_triangle[lane] != kNoHit,
                              (shading.contributed >> lane & 1) != 0,
                              static_cast<std::uint32_t>(content.children.size()), count});
      content.children.insert(content.children.end(), children_.begin() + begin,
                              children_.begin() + begin + count);
      open_bytes_ += content.num_bytes();
      if (content.num_bytes() > kMaxBlockBytes) write(number, content);
    }
    if (block.num_live == 0) {
      write(number, block.content);
      open_.erase(number);
    }
  }
}

void RayRecorder::write(std::uint64_t number, RayBlock& block) {
  if (block.rays.empty()) return;
  open_bytes_ -= block.num_bytes();
  const auto count = static_cast<std::uint32_t>(block.rays.size());
  const auto content = std::make_shared<const RayBlock>(std::move(block));
  writer_.add(number, count, [content, grid = grid_] {
    ByteVector raw;
    encode_ray_block(*content, grid, raw);
    return raw;
  });
  block = {};
}

void RayRecorder::write_largest() {
  // Of equal ones the lowest number, so that no hash order shows in the file.
  const auto smaller = [](const auto& a, const auto& b) {
    const std::size_t left = a.second.content.num_bytes();
    const std::size_t right = b.second.content.num_bytes();
    return left != right ? left < right : a.first > b.first;
  };
  const auto largest = std::max_element(open_.begin(), open_.end(), smaller);
  write(largest->first, largest->second.content);
}

void RayRecorder::flush() {
  while (open_bytes_ != 0) write_largest();
}

}  // namespace sheaf
