// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <tlm>
#include <vector>

#include "channels/timed_channel.h"
#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/crossbar.h"
#include "memory/memory_messages.h"
#include "memory/payload_pool.h"
#include "stats/counters.h"

namespace sheaf {

// Every request ends as exactly one of hit, miss or merge.
#define SHEAF_L2_COUNTERS(X)                                                                     \
  X(num_accesses, "requests", "Requests taken by a bank")                                        \
  X(num_hits, "requests", "Requests that found their line")                                      \
  X(num_misses, "requests", "Requests passed on to DRAM")                                        \
  X(num_merges, "requests", "Requests for a line that was on its way already")                   \
  X(num_mshr_stalls, "events", "Times a bank's first request had to wait for a free MSHR")       \
  X(num_target_stalls, "events", "Times as many requests waited for a line as its MSHR takes")   \
  X(num_writebacks, "lines", "Modified lines written to DRAM to make room")                      \
  X(bank_wait_cycles, "cycles", "Cycles that requests waited for their bank, summed")            \
  X(queue_occupancy_cycles, "cycles", "Requests waiting for their bank, summed over all cycles") \
  X(sum_miss_latency, "cycles", "Time from a miss to its line, summed over lines fetched")       \
  X(mshr_occupancy_cycles, "cycles", "MSHRs in use, summed over all cycles")                     \
  X(bytes_requested, "bytes", "Bytes asked for by private caches")                               \
  X(bytes_received, "bytes", "Bytes written by private caches")                                  \
  X(bytes_read, "bytes", "Bytes read from DRAM")                                                 \
  X(bytes_written, "bytes", "Bytes written to DRAM")
SHEAF_STATS(L2Stats, SHEAF_L2_COUNTERS);

#define SHEAF_L2_KIND_COUNTERS(X)                                      \
  X(num_accesses, "requests", "Requests for this kind of data")        \
  X(num_hits, "requests", "Of these, found in the L2")                 \
  X(bytes_read, "bytes", "Bytes read from DRAM for this kind of data") \
  X(bytes_written, "bytes", "Bytes of this kind that passed the L2 on their way to DRAM")
SHEAF_STATS(L2KindStats, SHEAF_L2_KIND_COUNTERS);

/// Shared second-level cache: banks interleaved by line behind a crossbar, MSHRs in each bank, DRAM
/// behind a TLM-2.0 socket (AT, non-blocking).
///
/// A bank takes `ports` requests a cycle in order of arrival (of the same cycle: in order of the
/// requesters' rank). The tag check takes hit_latency; a hit answers then, a miss asks DRAM then,
/// and a line that a fill pushes out is sent to DRAM hit_latency after the fill.
/// The L2 lags behind the calendar on purpose: what it does about a request is felt hit_latency
/// later, so it lets requests gather and takes them in one wake-up, in order of time.
///
/// A read miss with no free MSHR holds its bank up, as do as many writes under way to DRAM as the
/// write buffer has room for. A written line that is there becomes dirty, or goes on to DRAM too
/// (write-through); one that is not goes on to DRAM without taking a place, or is fetched and then
/// kept (write_allocate). `absent`: no storage, reads of the same line still share an MSHR;
/// `perfect`: every request hits.
///
/// A line here is what is fetched at a time, so a sector if lines are divided.
class L2Cache final : public sc_core::sc_module, public Agent {
 public:
  L2Cache(const sc_core::sc_module_name& name, const L2Spec& spec, const CrossbarSpec& crossbar,
          ClockDomain& domain);
  /// Behind a crossbar that holds nothing up.
  L2Cache(const sc_core::sc_module_name& name, const L2Spec& spec, ClockDomain& domain)
      : L2Cache(name, spec, {}, domain) {}

  sc_core::sc_port<TimedIn<LineRequest>> in_requests;
  /// One per requester, bound in the order of their numbers.
  sc_core::sc_port<TimedOut<LineResponse>, 0> out_responses;
  tlm_utils::simple_initiator_socket<L2Cache> to_dram;

  /// A memory that is an agent of the domain and answers later, a cycle after it acts at the
  /// earliest; to be told before the simulation starts.
  void expect_answers_from(std::size_t memory);

  Cycles wake(Cycles now) override;
  [[nodiscard]] std::string stuck_reason() const override;

  /// Takes over the tags of banks of the same shape; counts nothing. Of a line that is on its way
  /// there may be one already when it comes.
  void load(const std::vector<CacheArray>& banks);

  [[nodiscard]] const L2Stats& stats() const { return stats_; }
  [[nodiscard]] const L2KindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }
  /// If there is one to be modelled.
  [[nodiscard]] const std::optional<RequestCrossbar>& request_crossbar() const {
    return request_crossbar_;
  }
  [[nodiscard]] const std::optional<ResponseCrossbar>& response_crossbar() const {
    return response_crossbar_;
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
    Cycles since = 0;
    bool dirty = false;  ///< will have been written when it comes
    std::vector<LineRequest> waiters;
  };
  struct Bank {
    CacheArray array;
    std::deque<Request> queue = {};
    std::vector<Mshr> mshrs = {};  ///< the first num_mshrs are in use
    std::size_t num_mshrs = 0;
    Cycles free_at = 0;
    Cycles taken_at = kNever;     ///< of its last request
    std::uint32_t num_taken = 0;  ///< in that cycle
    std::uint32_t num_writes_out = 0;
    bool blocked = false;  ///< its first request waits for an MSHR
  };
  /// A line on its way from DRAM, or a write that has been done there. Of those of the same cycle
  /// the lowest address is first, in whatever order a memory of several channels gave notice of
  /// them.
  struct Answer {
    Cycles at = 0;
    Address address = 0;
    bool write = false;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees the comparison's own zero
    auto operator<=>(const Answer&) const = default;
  };
  /// A line as a bank sees it.
  struct Place {
    std::size_t bank = 0;
    std::uint64_t index = 0;
  };

  void end_of_elaboration() override;
  void start_of_simulation() override;
  void arrive(const LineRequest& request, Cycles now);
  void accept(const LineRequest& what, Cycles now);
  bool serve(Bank& bank, const Request& request, Cycles now);
  void serve_queues(Cycles now);
  void cross(Cycles now);
  bool serve_read(Bank& bank, const LineRequest& request, Cycles now);
  bool serve_write(Bank& bank, const LineRequest& request, Cycles now);
  bool write_missing(Bank& bank, const LineRequest& request, Cycles now);
  bool wait_for(Bank& bank, std::uint64_t& counter);
  [[nodiscard]] Mshr* find_mshr(Bank& bank, std::uint64_t line);
  Mshr& take_mshr(Bank& bank, const LineRequest& request, Cycles now);
  void respond(const LineRequest& request, Cycles ready);
  void send(const LineRequest& request, Cycles at);
  void put(const Place& where, bool dirty, Cycles now);
  void send_to_dram(Address address, Bytes bytes, bool write, Cycles at);
  void pass_on(const LineRequest& request, Cycles now);
  void dram_done(const tlm::tlm_generic_payload& payload, Cycles at);
  void take_answers(Cycles now);
  void fill(Address address, Cycles now);
  void act(Cycles event);
  void count_queued(std::ptrdiff_t change, Cycles now);
  void count_mshrs(std::ptrdiff_t change, Cycles now);
  [[nodiscard]] Cycles next_event() const { return next_event(0); }
  /// With requests put off by `lag`.
  [[nodiscard]] Cycles next_event(Cycles lag) const {
    Cycles next = *next_request_;
    if (num_queued_ != 0) next = std::min(next, next_queued());
    if (request_crossbar_) next = std::min(next, next_crossing());
    if (next != kNever) next += lag;
    if (response_crossbar_) next = std::min(next, response_crossbar_->next_event());
    return answers_.empty() ? next : std::min(next, answers_.top().at);
  }
  [[nodiscard]] Cycles next_queued() const;
  [[nodiscard]] Cycles next_crossing() const;
  [[nodiscard]] bool is_safe(Cycles event, Cycles now) const;
  L2KindStats& kind_of(const LineRequest& request) {
    return kind_stats_[static_cast<std::size_t>(request.kind)];
  }
  [[nodiscard]] std::uint64_t line_of(Address address) const { return address >> line_shift_; }
  [[nodiscard]] Place place_of(std::uint64_t line) const {
    const std::uint64_t tag = line >> sector_shift_;
    return {static_cast<std::size_t>(tag & (banks_.size() - 1)),
            (tag >> bank_shift_) << sector_shift_ | (line & (spec_.sectors - 1))};
  }
  [[nodiscard]] std::uint64_t line_at(const Place& place) const {
    const std::uint64_t tag = (place.index >> sector_shift_) << bank_shift_ | place.bank;
    return tag << sector_shift_ | (place.index & (spec_.sectors - 1));
  }
  [[nodiscard]] Bank& bank_of(std::uint64_t line) { return banks_[place_of(line).bank]; }
  [[nodiscard]] Bytes line_size() const { return Bytes{1} << line_shift_; }
  /// Whether the bank can take its next request when it is free.
  [[nodiscard]] bool can_take(const Bank& bank) const {
    const bool full = spec_.write.buffer != 0 && bank.num_writes_out >= spec_.write.buffer;
    return !bank.blocked && !full;
  }
  [[nodiscard]] bool has_room(std::size_t bank) const {
    return crossbar_.depth == 0 || banks_[bank].queue.size() < crossbar_.depth;
  }
  tlm::tlm_sync_enum nb_transport_bw(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay);

  const L2Spec spec_;
  const CrossbarSpec crossbar_;
  ClockDomain& domain_;
  std::size_t agent_;
  const Cycles lag_;
  Inbox inbox_;
  std::vector<std::size_t> memories_;  ///< agents that answer later
  Lookahead requests_ahead_;           ///< and fills
  unsigned line_shift_;
  unsigned bank_shift_;
  unsigned sector_shift_;
  std::vector<Bank> banks_;
  bool was_loaded_ = false;
  std::size_t num_queued_ = 0;       ///< requests in all banks' queues
  std::size_t num_outstanding_ = 0;  ///< MSHRs in use in all banks
  Cycles own_time_ = 0;              ///< of the last event
  Cycles queues_counted_until_ = 0, mshrs_counted_until_ = 0;
  std::optional<RequestCrossbar> request_crossbar_;
  std::optional<ResponseCrossbar> response_crossbar_;

  std::priority_queue<Answer, std::vector<Answer>, std::greater<>> answers_;
  std::vector<TimedOut<LineResponse>*> responses_;
  const Cycles* next_request_ = nullptr;

  PayloadPool payloads_;
  L2Stats stats_;
  std::array<L2KindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf
