// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "system/memory_system.h"
#include "tracefile/trace_metadata.h"
#include "units/elastic_unit.h"
#include "units/fixed_unit.h"
#include "units/replay_schedule.h"

namespace sheaf {

enum class ReplayMode : std::uint8_t {
  kElastic,  ///< accesses wait for those that they depend on
  kFixed     ///< accesses come in the cycles in which they were recorded
};

/// The caches and the memory of a configuration, driven by a memory trace in the place of units.
/// One machine a process (SystemC), ready to run once.
class ReplayMachine {
 public:
  /// Throws Error(kTrace) for a trace that this cannot be driven by.
  ReplayMachine(const Config& config, TraceReader& reader, const TraceMetadata& metadata,
                ReplayMode mode);

  using Monitor = std::function<bool(Cycles now)>;  ///< returns true to stop

  /// Runs until all is done, the monitor says stop or max_cycles is reached. Returns true if the
  /// trace has been replayed to its end. Throws Error(kTrace) if the trace turns out to be wrong,
  /// Error(kBug) if a conservation check fails.
  bool run(const Monitor& monitor);

  void report(StatsTree& stats) const;

 private:
  void build(TraceReader& reader, ReplayMode mode);
  [[nodiscard]] const PrivateCache& cache(std::size_t stream, std::size_t i) const;
  [[nodiscard]] bool is_finished() const;
  void check_conservation() const;

  const Config config_;
  const TraceMetadata& metadata_;
  ClockDomain domain_;
  MemorySystem memory_;
  ReplaySchedule schedule_;
  std::vector<std::unique_ptr<ElasticUnit>> elastic_;  ///< or:
  std::vector<std::unique_ptr<FixedUnit>> fixed_;
  Cycles end_ = 0;
};

}  // namespace sheaf
