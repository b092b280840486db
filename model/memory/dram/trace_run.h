// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "config/dram/device.h"
#include "memory/dram/dram_system.h"
#include "memory/dram/latency_record.h"
#include "memory/dram/text_trace.h"
#include "stats/report_tree.h"

namespace sheaf {

/// A memory driven alone by a list of accesses. Arrivals that find their queue full wait in front
/// of it, and those behind them wait with them; memory use does not depend on their number.
///
/// A latency runs from the acceptance into the queue to the last byte on the data bus, as Ramulator
/// 2 and DRAMsim3 count it; the wait for acceptance is reported beside it.
class TraceRun {
 public:
  /// `bytes`: of every access.
  TraceRun(const DramDevice& device, Bytes bytes);

  void add(const TraceAccess& access);
  /// Serves what is left. To be called once, after the last access.
  void finish();

  struct Result {
    LatencyRecord read_latency, write_latency;  ///< tCK
    /// tCK, for room in the queue. The sum grows with the square of the number of accesses if
    /// these come faster than they are served, so that 64 bits would not hold it.
    double sum_waits = 0;
    Cycles max_wait = 0;
    std::uint64_t num_wrapped = 0;      ///< accesses beyond the capacity
    Bytes bytes = 0;                    ///< asked for
    Cycles first_arrival = 0, end = 0;  ///< tCK; end: last byte
    DramChannelStats channels;

    /// Bytes a second from the first arrival to the last byte; 0 for no access.
    [[nodiscard]] double bandwidth(std::uint64_t clock_hz) const;
  };
  [[nodiscard]] const Result& result() const { return result_; }
  [[nodiscard]] const DramDevice& device() const { return memory_.device(); }

 private:
  void take(const DramSystem::Done& done);

  DramSystem memory_;
  const Bytes bytes_;
  const Bytes capacity_;
  std::uint64_t num_accesses_ = 0;
  std::uint64_t num_since_advance_ = 0;
  Result result_;
};

/// The result as dotted names below "memory".
void report_trace_run(const TraceRun& run, StatsTree& stats);

}  // namespace sheaf
