// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/coherence.h"

#include <utility>

#include "shading/packet_shader.h"
#include "system/reported_values.h"
#include "units/primary_source.h"

namespace sheaf {
namespace {

bool stamp(std::vector<std::uint32_t>& stamps, std::uint32_t index, std::uint32_t number) {
  const bool first = stamps[index] != number;
  stamps[index] = number;
  return first;
}

}  // namespace

CoherencePass::CoherencePass(Config config, const PreparedScene& scene)
    : config_(std::move(config)), scene_(scene) {
  for (Scope* scope : {&primary_, &secondary_}) {
    scope->node_stamps.resize(scene.tree.nodes.size());
    scope->triangle_stamps.resize(scene.triangles.size());
    scope->number = 1;
  }
}

bool CoherencePass::run(const std::function<bool()>& stop) {
  const int size = static_cast<int>(config_.packet.size);
  PacketShader shader(
      scene_.scene,
      {config_.render.recursion_level, static_cast<float>(config_.render.weight_cutoff)}, nullptr);
  PacketPool pool(size);
  PacketShading shading;
  TileOrder order(config_.image.width, config_.image.height, config_.flow.tile_size, size);
  std::vector<RayPacket*> pending;
  for (; !order.is_done(); order.next_tile()) {
    TileOrder::Run run;
    while (order.next_run(run)) {
      if (stop()) return false;
      RayPacket* packet = pool.acquire();
      make_primary_packet(scene_.scene.camera, config_.image, run, *packet);
      pending.push_back(packet);
      while (!pending.empty()) {
        RayPacket* next = pending.back();
        pending.pop_back();
        trace(*next, next == packet ? primary_ : secondary_);
        shader.shade(*next, shading);
        pool.release(next);
        if (next == packet) packet = nullptr;
        split_by_kind(shading.spawned, pool, pending);
      }
    }
    if (config_.measure.scope == MeasureScope::kTile) {
      ++primary_.number;
      ++secondary_.number;
    }
  }
  return true;
}

void CoherencePass::trace(RayPacket& packet, Scope& scope) {
  TraceCounts counts;
  trace_packet(TraversalScheme::kSingle, scene_.tree, scene_.triangles, packet, &log_, nullptr,
               counts);
  scope.counts.s_t += counts.lane_inner_visits;
  scope.counts.i_t += counts.lane_triangle_tests;
  for (const TraceStep& step : log_) {
    const KdNode& node = scene_.tree.nodes[step.node];
    if (!node.is_leaf()) {
      if (stamp(scope.node_stamps, step.node, scope.number)) ++scope.counts.s_u;
      continue;
    }
    for (std::uint32_t i = 0; i < step.num_tests; ++i) {
      const std::uint32_t triangle = scene_.tree.leaf_triangles[node.first() + i];
      if (stamp(scope.triangle_stamps, triangle, scope.number)) ++scope.counts.i_u;
    }
  }
}

void CoherencePass::report(bool has_secondary, StatsTree& stats) const {
  const auto add = [&](const std::string& path, const CoherenceCounts& counts) {
    stats.add_counters(path, counts);
    stats.add_ratio(path, CoherenceValues::c_t, counts.s_t, counts.s_u);
    stats.add_ratio(path, CoherenceValues::c_i, counts.i_t, counts.i_u);
  };
  add("coherence.primary", primary_.counts);
  if (has_secondary) add("coherence.secondary", secondary_.counts);
}

}  // namespace sheaf
