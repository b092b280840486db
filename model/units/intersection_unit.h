// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "units/line_fetcher.h"
#include "units/messages.h"
#include "units/multi_context_unit.h"
#include "units/traversal_unit.h"

namespace sheaf {

/// Tests a packet's rays against the triangles of a leaf: fetches the leaf's list, then triangle
/// after triangle its record and one step of the packet's lanes. The hits themselves have been
/// computed with the walk.
class IntersectionUnit final : public MultiContextUnit<IntersectionUnit> {
 public:
  IntersectionUnit(const sc_core::sc_module_name& name, const UnitSpec& spec, int packet_size,
                   const CacheSpec& cache, const TracedScene& scene, const AnswerTimes& times,
                   ClockDomain& domain, TimedOut<LineRequest>& memory, std::uint16_t requester);

  sc_core::sc_port<TimedIn<LeafJob>, 0> in_jobs;  ///< one per traversal unit
  sc_core::sc_port<TimedIn<LineResponse>> in_lines;
  sc_core::sc_port<TimedOut<LeafDone>, 0> out_done;  ///< one per traversal unit

  [[nodiscard]] const PrivateCache& cache() const { return cache_; }
  [[nodiscard]] PrivateCache& cache() { return cache_; }
  /// The job of a context that is held.
  [[nodiscard]] const LeafJob& job(int context) const {
    return contexts_[static_cast<std::size_t>(context)].job;
  }
  [[nodiscard]] std::string stuck_reason() const override;

  /// Has all its steps taken down; jobs come `link_latency` after they are sent.
  void record_to(StreamRecorder& recorder, Cycles link_latency) {
    recorder_ = &recorder;
    link_latency_ = link_latency;
  }

 private:
  friend class MultiContextUnit<IntersectionUnit>;
  enum class Phase : std::uint8_t { kList, kListIssued, kTriangle, kTriangleIssued };
  struct Context {
    LeafJob job;
    std::uint32_t tested = 0;
    Phase phase = Phase::kList;
  };

  void end_of_elaboration() override;
  void start_of_simulation() override;
  Cycles accept_inputs(Cycles now);
  bool ready(int context, Cycles now);
  void issue(int context, Cycles now);
  [[nodiscard]] Cycles earliest_input();
  void record_begin(int context, Cycles now);
  void record_step(int context, Cycles now);
  bool fetch(int context, Address first, Bytes bytes, DataKind kind, Cycles& port_cycles,
             Cycles now);

  const TracedScene scene_;
  const AnswerTimes times_;
  MergedInput<LeafJob> jobs_;
  PrivateCache cache_;
  LineFetcher fetcher_;
  std::vector<Context> contexts_;
  Lookahead jobs_ahead_;
  Lookahead lines_ahead_;
  StreamRecorder* recorder_ = nullptr;
  Cycles link_latency_ = 0;
};

}  // namespace sheaf
