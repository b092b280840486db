// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/shading_sorter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <span>
#include <utility>

namespace sheaf {
namespace {

constexpr std::uint32_t kUntextured = 0;

/// Materials that read the same textures have the same number.
std::vector<std::uint32_t> number_textures(const Scene& scene) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> numbers;
  numbers[{kNoTexture, kNoTexture}] = kUntextured;
  std::vector<std::uint32_t> of_material;
  for (const Material& material : scene.materials) {
    const std::pair textures(material.base_color_texture, material.emission_texture);
    const auto next = static_cast<std::uint32_t>(numbers.size());
    of_material.push_back(numbers.emplace(textures, next).first->second);
  }
  return of_material;
}

std::uint64_t count_distinct(std::span<std::uint32_t> values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::uint64_t>(std::unique(values.begin(), values.end()) - values.begin());
}

/// Takes a ray with what it hit from one packet to another.
void move_lane(RayPacket& from, int from_lane, RayPacket& to, int to_lane) {
  const auto f = static_cast<std::size_t>(from_lane);
  const auto t = static_cast<std::size_t>(to_lane);
  to.put(to_lane, from.get(from_lane));
  to.hit_t[t] = from.hit_t[f];
  to.hit_u[t] = from.hit_u[f];
  to.hit_v[t] = from.hit_v[f];
  to.hit_triangle[t] = from.hit_triangle[f];
  from.active &= ~(LaneMask{1} << from_lane);
}

}  // namespace

ShadingSorter::ShadingSorter(const ShaderCacheSpec& spec, const Scene& scene, PacketPool& pool)
    : scene_(scene),
      pool_(pool),
      key_(spec.key),
      textures_(number_textures(scene)),
      cells_(spec.cells) {}

void ShadingSorter::insert(RayPacket* packet, std::vector<RayPacket*>& departures) {
  ++stats_.num_packets_in;
  stats_.num_rays_in += static_cast<std::uint64_t>(std::popcount(packet->active));
  count_kinds(*packet, stats_.sum_materials_in, stats_.sum_textures_in);
  for (LaneMask left = packet->active & ~packet->any_hit; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (packet->hit_triangle[static_cast<std::size_t>(lane)] == kNoHit) continue;
    insert_lane(*packet, lane, departures);
  }
  if (packet->active == 0) {
    pool_.release(packet);
    return;
  }
  ++stats_.num_packets_bypassed;
  stats_.num_bypassed += static_cast<std::uint64_t>(std::popcount(packet->active));
  departures.push_back(packet);
}

void ShadingSorter::insert_lane(RayPacket& packet, int lane, std::vector<RayPacket*>& departures) {
  const std::uint32_t triangle = packet.hit_triangle[static_cast<std::size_t>(lane)];
  const std::uint32_t material = scene_.triangle_material[triangle];
  const std::uint32_t key = key_ == ShaderCacheKey::kMaterial ? material : textures_[material];
  ++stats_.num_insertions;
  const auto found = std::find_if(cells_.begin(), cells_.end(), [key](const Cell& cell) {
    return cell.packet != nullptr && cell.key == key;
  });
  ++(found != cells_.end() ? stats_.num_hits : stats_.num_misses);
  Cell& cell = found != cells_.end() ? *found : open(key, departures);
  move_lane(packet, lane, *cell.packet, cell.num_rays++);
  stats_.max_rays = std::max<std::uint64_t>(stats_.max_rays, ++num_waiting_);
  if (cell.num_rays == cell.packet->size) {
    ++stats_.num_packets_full;
    close(cell, stats_.num_rays_full, departures);
  }
}

/// A free cell, or that of the fullest, of equals the one opened first, which leaves.
ShadingSorter::Cell& ShadingSorter::open(std::uint32_t key, std::vector<RayPacket*>& departures) {
  auto cell =
      std::find_if(cells_.begin(), cells_.end(), [](const Cell& c) { return c.packet == nullptr; });
  if (cell == cells_.end()) {
    cell = std::min_element(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
      return a.num_rays != b.num_rays ? a.num_rays > b.num_rays : a.opening < b.opening;
    });
    ++stats_.num_evictions;
    close(*cell, stats_.num_rays_evicted, departures);
  }
  *cell = {pool_.acquire(), 0, key, ++rank_};
  return *cell;
}

void ShadingSorter::close(Cell& cell, std::uint64_t& rays, std::vector<RayPacket*>& departures) {
  const auto num_rays = static_cast<std::uint64_t>(cell.num_rays);
  rays += num_rays;
  num_waiting_ -= num_rays;
  count_kinds(*cell.packet, stats_.sum_materials_out, stats_.sum_textures_out);
  departures.push_back(cell.packet);
  cell = {};
}

void ShadingSorter::sweep(std::vector<RayPacket*>& departures) {
  for (Cell& cell : cells_) {
    if (cell.packet == nullptr) continue;
    ++stats_.num_packets_swept;
    close(cell, stats_.num_rays_swept, departures);
  }
}

void ShadingSorter::count_kinds(const RayPacket& packet, std::uint64_t& materials,
                                std::uint64_t& textures) const {
  std::array<std::uint32_t, kMaxPacketSize> material{};
  std::array<std::uint32_t, kMaxPacketSize> texture{};
  std::size_t num_hits = 0;
  std::size_t num_textured = 0;
  for (LaneMask left = packet.active & ~packet.any_hit; left != 0; left &= left - 1) {
    const std::uint32_t triangle =
        packet.hit_triangle[static_cast<std::size_t>(std::countr_zero(left))];
    if (triangle == kNoHit) continue;
    material[num_hits] = scene_.triangle_material[triangle];
    const std::uint32_t number = textures_[material[num_hits++]];
    if (number != kUntextured) texture[num_textured++] = number;
  }
  materials += count_distinct(std::span(material).first(num_hits));
  textures += count_distinct(std::span(texture).first(num_textured));
}

}  // namespace sheaf
