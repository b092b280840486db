// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <string>
#include <tlm>

#include "base/units.h"
#include "stats/counters.h"
#include "stats/report_tree.h"

namespace sheaf {

#define SHEAF_DRAM_COUNTERS(X)                                                  \
  X(num_reads, "requests", "Read requests")                                     \
  X(num_writes, "requests", "Write requests")                                   \
  X(bytes_read, "bytes", "Bytes read")                                          \
  X(bytes_written, "bytes", "Bytes written")                                    \
  X(bus_busy_cycles, "cycles", "Cycles in which the data bus moved data")       \
  X(sum_read_latency, "cycles", "Read latencies, request to last byte, summed") \
  X(max_read_latency, "cycles", "Longest read latency")
SHEAF_STATS(DramStats, SHEAF_DRAM_COUNTERS);

/// What stands behind the L2: a target of TLM-2.0's base protocol (AT, non-blocking).
class MainMemory : public sc_core::sc_module {
 public:
  explicit MainMemory(const sc_core::sc_module_name& name)
      : sc_module(name), from_cache("from_cache") {
    from_cache.register_nb_transport_fw(this, &MainMemory::nb_transport_fw);
  }

  tlm_utils::simple_target_socket<MainMemory> from_cache;

  /// The run has ended before core cycle `end`: goes on to there with what no request has asked
  /// for.
  virtual void finish(Cycles /*end*/) {}

  /// In core cycles, as of core cycle `end`. With several data buses, bus_busy_cycles is their
  /// mean.
  [[nodiscard]] virtual DramStats stats(Cycles end) const = 0;
  /// What only this kind of memory counts, below `path`.
  virtual void report_details(const std::string& path, Cycles end, StatsTree& stats) const = 0;

 protected:
  virtual tlm::tlm_sync_enum nb_transport_fw(tlm::tlm_generic_payload& payload,
                                             tlm::tlm_phase& phase, sc_core::sc_time& delay) = 0;
};

}  // namespace sheaf
