// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <tlm>

#include "base/units.h"
#include "config/config.h"
#include "stats/counters.h"

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

/// DRAM of fixed latency and bandwidth behind a TLM-2.0 socket: data starts to flow `latency` after
/// the request, or when the bus is free, and occupies the bus for bytes / bytes_per_cycle, rounded
/// up. Requests are taken in the order of the calls. Answers at once with TLM_COMPLETED and the
/// response's time as the annotated delay, so it needs no SystemC process.
class FixedDram final : public sc_core::sc_module {
 public:
  FixedDram(const sc_core::sc_module_name& name, const DramSpec& spec,
            const sc_core::sc_time& period);

  tlm_utils::simple_target_socket<FixedDram> from_cache;

  [[nodiscard]] const DramStats& stats() const { return stats_; }

 private:
  tlm::tlm_sync_enum nb_transport_fw(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay);

  const DramSpec spec_;
  const sc_core::sc_time period_;
  Cycles bus_free_ = 0;
  DramStats stats_;
};

}  // namespace sheaf
