// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "base/object_pool.h"
#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "image/film.h"
#include "kdtree/memory_map.h"
#include "memory/private_cache.h"
#include "stats/stall_account.h"
#include "tracefile/memory_recorder.h"
#include "units/flow_control.h"
#include "units/shader_unit.h"

namespace sheaf {

#define SHEAF_FILM_COUNTERS(X)                                     \
  X(num_batches, "batches", "Packets whose contributions came in") \
  X(num_contributions, "pixels", "Contributions added to a pixel")
SHEAF_STATS(FilmStats, SHEAF_FILM_COUNTERS);

/// Adds contributions to the frame buffer, one a cycle, in order of arrival, through a write-back
/// cache. An addition whose line is on its way waits in that line's MSHR, so that only a lack of
/// MSHRs, or of room for writes, holds the unit up. When the last ray has retired, the dirty lines
/// are written back, one a cycle.
class FilmUnit final : public sc_core::sc_module, public SteppingAgent {
 public:
  FilmUnit(const sc_core::sc_module_name& name, const CacheSpec& cache, Film& film,
           const MemoryMap& memory, ObjectPool<FilmBatch>& batches, FlowControl& flow,
           ClockDomain& domain, TimedOut<LineRequest>& requests, std::uint16_t requester);

  sc_core::sc_port<TimedIn<FilmBatch*>> in_batches;
  sc_core::sc_port<TimedIn<LineResponse>> in_lines;

  [[nodiscard]] std::string stuck_reason() const override;

  /// Has all its additions taken down; batches come `link_latency` after they are sent.
  void record_to(StreamRecorder& recorder, Cycles link_latency) {
    recorder_ = &recorder;
    link_latency_ = link_latency;
  }

  [[nodiscard]] const FilmStats& stats() const { return stats_; }
  [[nodiscard]] const PrivateCache& cache() const { return cache_; }
  [[nodiscard]] PrivateCache& cache() { return cache_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  void accept_lines(Cycles now);
  bool add_next(Cycles now);
  void record_addition(Address pixel, Cycles now);
  Cycles flush_next(Cycles now);

  Film& film_;
  const MemoryMap& memory_;
  ObjectPool<FilmBatch>& batches_;
  FlowControl& flow_;
  Inbox inbox_;
  PrivateCache cache_;
  FilmBatch* batch_ = nullptr;  ///< being added
  std::size_t position_ = 0;
  Bytes bytes_asked_for_ = 0;  ///< of the pixel of the contribution at position_
  bool waits_for_room_ = false;
  std::vector<std::uint64_t> dirty_lines_;
  bool flushing_ = false;
  FilmStats stats_;
  StallAccount stalls_;
  StreamRecorder* recorder_ = nullptr;
  std::size_t recorded_ = 0;  ///< contributions of the batch that have been taken down
  Cycles link_latency_ = 0;
};

}  // namespace sheaf
