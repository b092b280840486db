// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/l2_cache.h"
#include "memory/memory_messages.h"
#include "units/clocked/dram.h"
#include "units/clocked/link.h"

namespace sheaf::clocked {

/// Shared second-level cache: banks interleaved by line, each with a queue and MSHRs. In every
/// cycle, in this order,
///
///  1. the hits found hit_latency ago are answered;
///  2. lines that have come from DRAM are handed on and take their place;
///  3. each bank whose requests have waited takes the first of them;
///  4. requests that arrive now, of the lowest requester first, are taken by their bank if it is
///     free, or queue.
///
/// A request to DRAM leaves hit_latency after the look-up that missed, or the fill that pushed a
/// modified line out.
class L2Cache {
 public:
  L2Cache(const L2Spec& spec, Dram& dram);

  std::vector<Link<LineRequest>*> in_requests;     ///< by requester
  std::vector<Link<LineResponse>*> out_responses;  ///< by requester

  void tick(Cycles now);

  [[nodiscard]] const L2Stats& stats() const { return stats_; }
  [[nodiscard]] const L2KindStats& kind_stats(DataKind kind) const {
    return kind_stats_[static_cast<std::size_t>(kind)];
  }
  /// Nothing queued, nothing outstanding.
  [[nodiscard]] bool is_idle() const;
  /// It will go on by itself: a line is on its way, or a request will be taken.
  [[nodiscard]] bool is_moving() const;

 private:
  struct Request {
    LineRequest what;
    Cycles arrival = 0;
  };
  struct Mshr {
    std::uint64_t line = 0;
    Cycles since = 0;
    std::vector<LineRequest> waiters;
  };
  struct Bank {
    CacheArray array;
    std::deque<Request> queue;
    std::vector<Mshr> mshrs;
    Cycles free_at = 0;
    bool blocked = false;  ///< its first request waits for an MSHR
  };
  void fill(Address address, Cycles now);
  void accept(const LineRequest& request, Cycles now);
  bool serve(Bank& bank, const Request& request, Cycles now);
  bool serve_read(Bank& bank, const LineRequest& request, Cycles now);
  void serve_write(Bank& bank, const LineRequest& request, Cycles now);
  void send_to_dram(Address address, Bytes bytes, bool write, Cycles now);
  [[nodiscard]] std::uint64_t line_of(Address address) const { return address / spec_.line; }
  [[nodiscard]] Bank& bank_of(std::uint64_t line) { return banks_[line % banks_.size()]; }
  L2KindStats& kind_of(const LineRequest& request) {
    return kind_stats_[static_cast<std::size_t>(request.kind)];
  }

  const L2Spec spec_;
  Dram& dram_;
  std::vector<Bank> banks_;
  Link<LineRequest> hits_;  ///< on their way through the arrays
  L2Stats stats_;
  std::array<L2KindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf::clocked
