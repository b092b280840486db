// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "units/clocked/context_unit.h"
#include "units/messages.h"
#include "units/traversal_unit.h"

namespace sheaf::clocked {

/// Walks packets through the kd-tree: set-up, then a node fetch and a step for each node, and for
/// each leaf with triangles a job whose answer the context awaits.
class TraversalUnit final : public ContextUnit {
 public:
  TraversalUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size,
                const TracedScene& scene, HeatMaps& heat, std::uint16_t number, Cache cache);

  Link<RayPacket*>* in_packets = nullptr;
  Link<LeafDone>* in_done = nullptr;
  Outputs<LeafJob> out_jobs;        ///< one per intersection unit
  Outputs<RayPacket*> out_packets;  ///< one per shader unit
  Link<ContextFree>* out_free = nullptr;

  [[nodiscard]] const TraceCounts& primary_counts() const { return primary_counts_; }
  [[nodiscard]] const TraceCounts& secondary_counts() const { return secondary_counts_; }
  [[nodiscard]] const Cache& cache() const { return cache_; }

 private:
  enum class Phase : std::uint8_t { kSetup, kStep, kJob, kAnswered, kDone };
  struct Walk {
    RayPacket* packet = nullptr;
    TraceLog log;
    std::size_t step = 0;  ///< of the log
    Phase phase = Phase::kSetup;
    bool issued = false;  ///< set-up or step: it is in the pipeline
  };
  void accept(Cycles now) override;
  void resume(int context, Cycles now) override;
  void issue(int context, Cycles now) override;
  void trace(RayPacket* packet, Walk& walk);
  void begin_step(int context, Cycles now);
  void send_job(int context, Cycles now);
  void send_packet(int context, Cycles now);
  [[nodiscard]] Walk& walk(int context) { return walks_[static_cast<std::size_t>(context)]; }

  const TracedScene scene_;
  HeatMaps& heat_;
  const std::uint16_t number_;
  Cache cache_;
  std::vector<Walk> walks_;
  TraceCounts primary_counts_;
  TraceCounts secondary_counts_;
};

}  // namespace sheaf::clocked
