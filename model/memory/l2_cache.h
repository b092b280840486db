// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <tlm>
#include <vector>

#include "channels/timed_channel.h"
#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/memory_messages.h"
#include "memory/payload_pool.h"
#include "stats/counters.h"

namespace sheaf {

// Every read request ends as exactly one of hit, miss or merge; writes as hit or miss.
#define SHEAF_L2_COUNTERS(X)                                                               \
  X(num_accesses, "requests", "Requests taken by a bank")                                  \
  X(num_hits, "requests", "Requests that found their line")                                \
  X(num_misses, "requests", "Requests passed on to DRAM")                                  \
  X(num_merges, "requests", "Requests for a line that was on its way already")             \
  X(num_mshr_stalls, "events", "Times a bank's first request had to wait for a free MSHR") \
  X(num_writebacks, "lines", "Modified lines written to DRAM to make room")                \
  X(bank_wait_cycles, "cycles", "Cycles that requests waited for their bank, summed")      \
  X(bytes_requested, "bytes", "Bytes asked for by private caches")                         \
  X(bytes_received, "bytes", "Bytes written by private caches")                            \
  X(bytes_read, "bytes", "Bytes read from DRAM")                                           \
  X(bytes_written, "bytes", "Bytes written to DRAM")
SHEAF_STATS(L2Stats, SHEAF_L2_COUNTERS);

#define SHEAF_L2_KIND_COUNTERS(X)                                      \
  X(num_accesses, "requests", "Requests for this kind of data")        \
  X(num_hits, "requests", "Of these, found in the L2")                 \
  X(bytes_read, "bytes", "Bytes read from DRAM for this kind of data") \
  X(bytes_written, "bytes", "Bytes of this kind that passed the L2 on their way to DRAM")
SHEAF_STATS(L2KindStats, SHEAF_L2_KIND_COUNTERS);

/// Shared second-level cache: banks interleaved by line behind a crossbar, LRU, MSHRs in each bank,
/// DRAM behind a TLM-2.0 socket (AT, non-blocking).
///
/// A bank takes one request a cycle in order of arrival (of the same cycle: in order of the
/// requesters' rank). The tag check takes hit_latency; a hit answers then, a miss asks DRAM then,
/// and a line that a fill pushes out is sent to DRAM hit_latency after the fill.
/// The L2 lags behind the calendar on purpose: what it does about a request is felt hit_latency
/// later, so it lets requests gather and takes them in one wake-up, in order of time.
///
/// A read miss with no free MSHR holds its bank up. A written-back line that is there becomes
/// dirty; one that is not goes on to DRAM without taking a place. `absent`: no storage, reads of
/// the same line still share an MSHR; `perfect`: every request hits.
class L2Cache final : public sc_core::sc_module, public Agent {
 public:
  L2Cache(const sc_core::sc_module_name& name, const L2Spec& spec, ClockDomain& domain);

  sc_core::sc_port<TimedIn<LineRequest>> in_requests;
  /// One per requester, bound in the order of their numbers.
  sc_core::sc_port<TimedOut<LineResponse>, 0> out_responses;
  tlm_utils::simple_initiator_socket<L2Cache> to_dram;

  /// A memory that is an agent of the domain and answers later, a cycle after it acts at the
  /// earliest; to be told before the simulation starts.
  void expect_answers_from(std::size_t memory);

  Cycles wake(Cycles now) override;
  [[nodiscard]] std::string stuck_reason() const override;

  [[nodiscard]] const L2Stats& stats() const { return stats_; }
  [[nodiscard]] const L2KindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }
  /// Nothing queued, nothing outstanding.
  [[nodiscard]] bool is_idle() const;

 private:
  struct Request {
    LineRequest what;
    Cycles arrival = 0;
  };
  struct Mshr {
    std::uint64_t line = 0;
    std::vector<LineRequest> waiters;
  };
  struct Bank {
    CacheArray array;
    std::deque<Request> queue;
    std::vector<Mshr> mshrs;  ///< the first num_mshrs are in use
    std::size_t num_mshrs = 0;
    Cycles free_at = 0;
    bool blocked = false;  ///< its first request waits for an MSHR
  };
  /// A line on its way from DRAM. Of those that come in the same cycle the lowest address is first,
  /// in whatever order a memory of several channels gave notice of them.
  struct Fill {
    Cycles at = 0;
    Address address = 0;
    auto operator<=>(const Fill&) const = default;
  };

  void end_of_elaboration() override;
  void start_of_simulation() override;
  void accept(const LineRequest& request, Cycles now);
  bool serve(Bank& bank, const Request& request, Cycles now);
  void serve_queues(Cycles now);
  bool serve_read(Bank& bank, const LineRequest& request, Cycles now);
  void serve_write(Bank& bank, const LineRequest& request, Cycles now);
  void send_to_dram(Address address, Bytes bytes, bool write, Cycles at);
  void dram_done(const tlm::tlm_generic_payload& payload, Cycles at);
  void fill(Address address, Cycles now);
  void act(Cycles event);
  [[nodiscard]] Cycles next_event() const { return next_event(0); }
  [[nodiscard]] Cycles next_event(Cycles lag) const;
  [[nodiscard]] bool is_safe(Cycles event, Cycles now) const;
  L2KindStats& kind_of(const LineRequest& request) {
    return kind_stats_[static_cast<std::size_t>(request.kind)];
  }
  [[nodiscard]] std::uint64_t line_of(Address address) const { return address >> line_shift_; }
  [[nodiscard]] Bank& bank_of(std::uint64_t line) { return banks_[line & (banks_.size() - 1)]; }
  [[nodiscard]] std::uint64_t index_in_bank(std::uint64_t line) const {
    return line >> bank_shift_;
  }
  tlm::tlm_sync_enum nb_transport_bw(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay);

  const L2Spec spec_;
  ClockDomain& domain_;
  std::size_t agent_;
  const Cycles lag_;
  Inbox inbox_;
  std::vector<std::size_t> memories_;  ///< agents that answer later
  Lookahead requests_ahead_;           ///< and fills
  unsigned line_shift_;
  unsigned bank_shift_;
  std::vector<Bank> banks_;
  std::size_t num_queued_ = 0;  ///< requests in all banks' queues
  Cycles own_time_ = 0;         ///< of the last event

  std::priority_queue<Fill, std::vector<Fill>, std::greater<>> fills_;
  std::vector<TimedOut<LineResponse>*> responses_;
  const Cycles* next_request_ = nullptr;

  PayloadPool payloads_;
  L2Stats stats_;
  std::array<L2KindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf
