// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/config.h"
#include "scene/scene.h"
#include "stats/counters.h"
#include "traversal/packet_pool.h"

namespace sheaf {

// Rays in = insertions + bypassed; every insertion is a hit or a miss.
#define SHEAF_SHADER_CACHE_COUNTERS(X)                                                           \
  X(num_packets_in, "packets", "Traced packets taken in")                                        \
  X(num_rays_in, "rays", "Rays in these packets")                                                \
  X(num_bypassed, "rays", "Rays that need no material: shadow rays, and those that met nothing") \
  X(num_packets_bypassed, "packets", "Packets of such rays, sent on at once")                    \
  X(num_insertions, "rays", "Rays that entered a cell")                                          \
  X(num_hits, "rays", "Rays whose cell was open already")                                        \
  X(num_misses, "rays", "Rays for which a cell was opened")                                      \
  X(num_evictions, "cells", "Cells closed to make room for another")                             \
  X(num_packets_full, "packets", "Packets that left because their cell was full")                \
  X(num_packets_swept, "packets", "Packets swept out because nothing else could move")           \
  X(num_rays_full, "rays", "Rays in packets that left full")                                     \
  X(num_rays_evicted, "rays", "Rays in packets that left evicted")                               \
  X(num_rays_swept, "rays", "Rays in packets swept out")                                         \
  X(sum_materials_in, "materials", "Different materials of each packet that came, summed")       \
  X(sum_materials_out, "materials", "Different materials of each packet that left, summed")      \
  X(sum_textures_in, "textures", "Different textures of each packet that came, summed")          \
  X(sum_textures_out, "textures", "Different textures of each packet that left, summed")         \
  X(max_rays, "rays", "Most rays waiting in cells at a time")
SHEAF_STATS(ShaderCacheStats, SHEAF_SHADER_CACHE_COUNTERS);

/// The cells of the shader cache: regroups traced packets so that rays which met the same material,
/// or the same textures, are shaded together (Månsson, Munkberg and Akenine-Möller 2007 propose
/// that as future work). Rays keep what they hit. Knows no time.
class ShadingSorter {
 public:
  ShadingSorter(const ShaderCacheSpec& spec, const Scene& scene, PacketPool& pool);

  /// Takes a packet; those that leave, perhaps itself with the rays that need no material, are
  /// appended to `departures`.
  void insert(RayPacket* packet, std::vector<RayPacket*>& departures);
  /// Packets of all rays that wait.
  void sweep(std::vector<RayPacket*>& departures);

  [[nodiscard]] std::size_t num_waiting() const { return num_waiting_; }
  [[nodiscard]] const ShaderCacheStats& stats() const { return stats_; }

 private:
  struct Cell {
    RayPacket* packet = nullptr;  ///< null: not open
    int num_rays = 0;
    std::uint32_t key = 0;
    std::uint64_t opening = 0;  ///< rank
  };

  void insert_lane(RayPacket& packet, int lane, std::vector<RayPacket*>& departures);
  [[nodiscard]] Cell& open(std::uint32_t key, std::vector<RayPacket*>& departures);
  void close(Cell& cell, std::uint64_t& rays, std::vector<RayPacket*>& departures);
  void count_kinds(const RayPacket& packet, std::uint64_t& materials,
                   std::uint64_t& textures) const;

  const Scene& scene_;
  PacketPool& pool_;
  const ShaderCacheKey key_;
  std::vector<std::uint32_t> textures_;  ///< of each material: a number for its set of textures
  std::vector<Cell> cells_;
  std::uint64_t rank_ = 0;
  std::size_t num_waiting_ = 0;
  ShaderCacheStats stats_;
};

}  // namespace sheaf
