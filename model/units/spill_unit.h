// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <systemc>
#include <vector>

#include "channels/stepping_agent.h"
#include "channels/timed_channel.h"
#include "memory/memory_messages.h"
#include "sorting/spawn_bundle.h"
#include "stats/counters.h"
#include "stats/stall_account.h"

namespace sheaf {

// Every ray that comes in ends as exactly one of kept and spilled, and every spilled one returns.
#define SHEAF_SPILL_COUNTERS(X)                                                                   \
  X(num_bundles, "bundles", "Bundles of spawned rays that came in")                               \
  X(num_rays, "rays", "Rays that came in")                                                        \
  X(num_rays_kept, "rays", "Of these, stayed on chip")                                            \
  X(num_rays_spilled, "rays", "Of these, were written to memory")                                 \
  X(num_rays_returned, "rays", "Spilled rays that came back")                                     \
  X(num_lines_written, "lines", "Lines of rays written to memory")                                \
  X(num_lines_read, "lines", "Lines of rays read back")                                           \
  X(sum_spill_latency, "cycles",                                                                  \
    "From a bundle's arrival to its return, summed over spilled bundles")                         \
  X(max_spill_latency, "cycles", "Longest of these")                                              \
  X(num_bundles_spilled, "bundles", "Bundles that were written to memory")                        \
  X(max_rays_in_memory, "rays", "Most rays in memory at a time")                                  \
  X(max_rays_queued, "rays", "Most rays on chip at a time, in the queue or on their way to it")   \
  X(sum_queue_residence, "cycles", "Time of rays in the queue, from a place being given, summed") \
  X(queue_occupancy_cycles, "cycles",                                                             \
    "Rays in the queue or on their way to it, summed over all cycles")
SHEAF_STATS(SpillStats, SHEAF_SPILL_COUNTERS);

/// Flow control `spill`: the queue in front of the ray cache, of bounded size, whose overflow goes
/// to memory and comes back in order.
///
/// A bundle enters the queue if nothing that came before it is elsewhere and it fits, or the queue
/// is empty; else it is written to memory, a line a cycle. As soon as the oldest bundle in memory
/// fits, its place is taken and its lines are read, a line a cycle, before anything is written. A
/// shader waits while a bundle is being written, which nothing holds up for ever.
class SpillUnit final : public sc_core::sc_module, public SteppingAgent {
 public:
  /// Bytes of a ray in memory: its 43 bytes (rtl_notes, symbol R) in whole words of 16.
  static constexpr Bytes kRayBytes = 48;

  struct Spec {
    std::uint32_t queue = 1;  ///< rays
    Bytes line = 64;          ///< of a request to memory
    Address base = 0;         ///< where spilled rays go, from there on
    std::uint16_t requester = 0;
  };
  SpillUnit(const sc_core::sc_module_name& name, const Spec& spec, TimedOut<LineRequest>& requests,
            ClockDomain& domain);

  sc_core::sc_port<TimedIn<SpawnBundle*>> in_bundles;
  sc_core::sc_port<TimedOut<SpawnBundle*>> out_bundles;
  sc_core::sc_port<TimedIn<LineResponse>> in_lines;

  [[nodiscard]] std::string stuck_reason() const override;

  [[nodiscard]] const SpillStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }
  [[nodiscard]] Bytes line() const { return spec_.line; }
  [[nodiscard]] bool is_idle() const {
    return queue_.empty() && returning_.empty() && spilled_.empty() && writing_.bundle == nullptr;
  }

 private:
  /// A bundle that is not on its way out yet.
  struct Held {
    SpawnBundle* bundle = nullptr;
    Cycles arrival = 0;
    Cycles queued = 0;            ///< when its place in the queue was taken
    Address address = 0;          ///< in memory
    std::uint32_t num_lines = 0;  ///< there
    std::uint32_t requested = 0;  ///< lines written, or asked for
    std::uint32_t missing = 0;    ///< lines not read yet
    [[nodiscard]] std::size_t rays() const { return bundle->rays.size(); }
  };

  void end_of_elaboration() override;
  Cycles act(Cycles now) override;
  void take_lines(Cycles now);
  bool send_on(Cycles now);
  bool use_memory_port(Cycles now);
  bool read_back(Cycles now);
  bool write_out(Cycles now);
  bool take_bundle(Cycles now);
  void reserve(Held& held, Cycles now);
  void change_queue(std::ptrdiff_t rays, Cycles now);
  void request(const Held& held, bool write, Cycles now);
  [[nodiscard]] bool fits(std::size_t rays) const {
    return rays_queued_ == 0 || rays_queued_ + rays <= spec_.queue;
  }

  const Spec spec_;
  TimedOut<LineRequest>& requests_;
  Inbox inbox_;
  std::deque<Held> queue_;      ///< wait for the ray cache
  std::deque<Held> returning_;  ///< have a place in the queue, are being read
  std::deque<Held> spilled_;    ///< in memory
  Held writing_;                ///< being written, if any
  Address next_address_;
  std::size_t rays_queued_ = 0;     ///< in queue_ and returning_
  std::size_t rays_in_memory_ = 0;  ///< in spilled_ and returning_
  Cycles counted_until_ = 0;        ///< of queue_occupancy_cycles
  SpillStats stats_;
  StallAccount stalls_;
};

}  // namespace sheaf
