// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kdtree/kd_tree.h"
#include "kdtree/memory_map.h"
#include "tracefile/memory_recorder.h"
#include "traversal/trace.h"
#include "units/line_fetcher.h"
#include "units/link_choice.h"
#include "units/messages.h"
#include "units/multi_context_unit.h"

namespace sheaf {

/// The tree as the timed units see it: what is stored where, and how packets walk it.
struct TracedScene {
  const KdTree& tree;
  const std::vector<TriangleRecord>& triangles;
  const MemoryMap& memory;
  TraversalScheme scheme;
};

/// Lower bounds on when answers come, from which a unit knows how far it may run ahead.
struct AnswerTimes {
  Cycles line = 2;        ///< from a request for a line to its arrival
  Cycles leaf_fixed = 2;  ///< of a leaf job, from sending to the answer's arrival, without tests
  Cycles leaf_test = 1;   ///< for each test
};

/// Per-pixel counters for heat maps; empty vectors where none is asked for.
struct HeatMaps {
  std::vector<std::uint32_t> rays;
  std::vector<std::uint32_t> node_visits;
  std::vector<std::uint32_t> triangle_tests;
  [[nodiscard]] bool wanted() const {
    return !rays.empty() || !node_visits.empty() || !triangle_tests.empty();
  }
  void add(const RayPacket& packet, const LaneCounts& lanes);
};

/// Walks packets through the kd-tree. The walk itself is computed when a packet arrives, since no
/// hit depends on time; what it touched is then replayed step by step in time: set-up (box test
/// and signs), a node fetch and a step for every node, and a job for the intersection units, whose
/// answer is awaited, for every leaf with triangles.
class TraversalUnit final : public MultiContextUnit<TraversalUnit> {
 public:
  TraversalUnit(const sc_core::sc_module_name& name, const UnitSpec& spec, int packet_size,
                const CacheSpec& cache, const TracedScene& scene, const AnswerTimes& times,
                HeatMaps* heat, ClockDomain& domain, std::uint16_t number,
                TimedOut<LineRequest>& memory, std::uint16_t requester);

  sc_core::sc_port<TimedIn<RayPacket*>> in_packets;
  sc_core::sc_port<TimedIn<LeafDone>> in_done;
  sc_core::sc_port<TimedIn<LineResponse>> in_lines;
  sc_core::sc_port<TimedOut<LeafJob>, 0> out_jobs;        ///< one per intersection unit
  sc_core::sc_port<TimedOut<RayPacket*>, 0> out_packets;  ///< one per shader unit
  sc_core::sc_port<TimedOut<ContextFree>> out_free;

  [[nodiscard]] const TraceCounts& primary_counts() const { return primary_counts_; }
  [[nodiscard]] const TraceCounts& secondary_counts() const { return secondary_counts_; }
  [[nodiscard]] const PrivateCache& cache() const { return cache_; }
  [[nodiscard]] PrivateCache& cache() { return cache_; }
  /// The packet of a context that is held.
  [[nodiscard]] const RayPacket* packet(int context) const {
    return contexts_[static_cast<std::size_t>(context)].packet;
  }
  [[nodiscard]] std::string stuck_reason() const override;

  /// Has all its steps taken down.
  void record_to(StreamRecorder& recorder) { recorder_ = &recorder; }

 private:
  friend class MultiContextUnit<TraversalUnit>;
  enum class Phase : std::uint8_t {
    kSetup,
    kSetupIssued,
    kStep,
    kStepIssued,
    kJob,
    kAnswered,
    kDone
  };
  struct Context {
    RayPacket* packet = nullptr;
    TraceLog log;
    const TraceStep* step = nullptr;  ///< of the log, the one that is being replayed
    const TraceStep* end = nullptr;
    Phase phase = Phase::kSetup;
  };

  void end_of_elaboration() override;
  void start_of_simulation() override;
  Cycles accept_inputs(Cycles now);
  void accept_packet(RayPacket* packet, Cycles now);
  bool ready(int context, Cycles now);
  void issue(int context, Cycles now);
  [[nodiscard]] Cycles earliest_input();
  void record_step(int context, Cycles now);
  bool begin_step(int context, Cycles now);
  void send_job(int context, Cycles now);
  void send_packet(int context, Cycles now);

  const TracedScene scene_;
  const AnswerTimes times_;
  HeatMaps* heat_;
  const std::uint16_t number_;
  PrivateCache cache_;
  LineFetcher fetcher_;
  std::vector<Context> contexts_;
  TraceCounts primary_counts_;
  TraceCounts secondary_counts_;
  Lookahead packets_ahead_;
  Lookahead answers_ahead_;
  Lookahead lines_ahead_;
  RoundRobin<LeafJob> jobs_;
  RoundRobin<RayPacket*> packets_;
  StreamRecorder* recorder_ = nullptr;
};

}  // namespace sheaf
