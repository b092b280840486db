// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "config/config.h"
#include "stats/counters.h"
#include "system/functional_observer.h"
#include "system/functional_pipeline.h"
#include "system/observation.h"
#include "system/prepared_scene.h"
#include "system/tag_hierarchy.h"

namespace sheaf {

// What a resource of the machine would need for its share of the work if it alone counted.
#define SHEAF_BOUND_VALUES(X)                                                          \
  X(primary_source, "cycles", "Issue of primary packets")                              \
  X(ray_cache, "cycles", "Intake of spawned rays")                                     \
  X(traversal_issue, "cycles", "Issue slots of the traversal units")                   \
  X(traversal_contexts, "cycles", "Latencies of all packets' walks over all contexts") \
  X(intersection_issue, "cycles", "Issue slots of the intersection units")             \
  X(intersection_contexts, "cycles", "Latencies of all leaf jobs over all contexts")   \
  X(shader_issue, "cycles", "Issue slots of the shader units")                         \
  X(shader_contexts, "cycles", "Latencies of all packets' shading over all contexts")  \
  X(film, "cycles", "Contributions to pixels")                                         \
  X(l2_banks, "cycles", "Requests to the L2, spread evenly over its banks")            \
  X(dram_bus, "cycles", "Bytes over the peak bandwidth of DRAM")                       \
  X(serial, "cycles",                                                                  \
    "The longest packet of each depth, one after the other, tile after tile; "         \
    "none if tiles overlap")
SHEAF_STATS(BoundCycles, SHEAF_BOUND_VALUES);

/// Tiles of the picture.
[[nodiscard]] std::uint32_t num_tiles(const Config& config);

/// What one tile was found to need.
struct TileWork {
  Observation seen;  ///< of the untimed run; kCycles: the estimate
  BoundCycles bounds;
};

/// Roofline of the machine, made of an untimed run: for each resource the cycles that its work
/// takes at least, tile by tile. What hits in which cache comes from the tags alone (LRU order of
/// the untimed access stream); a miss costs the latency of the level that has the line.
///
/// The estimate of a tile is the largest of its bounds (Williams, Waterman and Patterson,
/// "Roofline: an insightful visual performance model for multicore architectures", CACM 52(4),
/// 2009). Of a frame it is the sum over its tiles; with credits, where tiles overlap, the largest
/// bound of all of them together.
class AnalyticModel final : public FunctionalObserver {
 public:
  AnalyticModel(const Config& config, const PreparedScene& scene);

  /// Traces the frame; false if `monitor` stopped it, from where it can go on.
  bool run(FunctionalPipeline& pipeline, const FunctionalPipeline::Monitor& monitor);

  /// Keeps the caches as they are when this tile begins, which must be still to come.
  void take_snapshot_at(std::uint32_t tile) {
    snapshot_at_ = tile;
    snapshot_.reset();
  }
  [[nodiscard]] bool has_snapshot() const { return snapshot_.has_value(); }
  [[nodiscard]] const TagHierarchy& snapshot() const { return *snapshot_; }

  /// The whole frame, once it has been traced.
  [[nodiscard]] TileWork frame() const;
  /// In the order of the tiles' numbers.
  [[nodiscard]] std::span<const TileWork> tiles() const { return tiles_; }

  void tile_begins(std::uint32_t tile) override;
  void traced(const RayPacket& packet, const TraceLog& log) override;
  void shaded(const RayPacket& packet, const PacketShading& shading) override;

 private:
  /// Cycles that something took: of an issue port, and from begin to end.
  struct Spent {
    Cycles issue = 0;
    Cycles latency = 0;
    Spent& operator+=(const Spent& other) {
      issue += other.issue;
      latency += other.latency;
      return *this;
    }
  };
  /// Sums of one tile, over all units of a kind.
  struct Demand {
    std::uint64_t primary_packets = 0;
    std::uint64_t spawned_rays = 0;
    std::uint64_t contributions = 0;
    Spent traversal, intersection, shader;
    std::vector<Cycles> longest_walk;     ///< by depth
    std::vector<Cycles> longest_shading;  ///< by depth
  };

  using Cache = TagHierarchy::Cache;
  [[nodiscard]] Cycles latency_of(TagHierarchy::Served served) const;
  Spent step(const UnitSpec& unit, Cycles slots, Cycles hit_latency, Cycles lookups, Cycles miss);
  Cycles read_lines(Cache cache, std::size_t unit, Address first, Bytes bytes, Cycles& lookups);
  Spent leaf_job(std::uint32_t leaf, std::uint32_t num_tests);
  Spent fetch_lines(Cache cache, const CacheSpec& spec, std::vector<std::uint64_t>& lines);
  void add_to_film(const PacketShading& shading);
  void end_tile();
  [[nodiscard]] Observation observe() const;
  [[nodiscard]] BoundCycles bounds(const Demand& demand, const Observation& seen) const;

  const Config config_;
  const PreparedScene& scene_;
  const double dram_bytes_per_cycle_;
  const Cycles dram_latency_;
  const Bytes bytes_per_pixel_;
  TagHierarchy tags_;
  const FunctionalPipeline* pipeline_ = nullptr;
  std::vector<TileWork> tiles_;
  Demand demand_;
  Observation tile_start_;
  std::uint32_t tile_ = 0;
  bool in_tile_ = false;
  std::optional<std::uint32_t> snapshot_at_;
  std::optional<TagHierarchy> snapshot_;
  std::size_t next_traversal_ = 0, next_intersection_ = 0, next_shader_ = 0;
  std::vector<std::uint64_t> lines_;  ///< asked for together, or on their way
};

}  // namespace sheaf
