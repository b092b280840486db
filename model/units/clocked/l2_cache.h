// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "config/config.h"
#include "memory/cache_array.h"
#include "memory/l2_cache.h"
#include "memory/memory_messages.h"
#include "units/clocked/crossbar.h"
#include "units/clocked/dram.h"
#include "units/clocked/link.h"

namespace sheaf::clocked {

/// Shared second-level cache: banks interleaved by line, each with a queue, ports and MSHRs. A line
/// here is what is fetched at a time, a sector if lines are divided. In every cycle, in this order,
///
///  1. what was looked up hit_latency ago is answered;
///  2. lines that have come from DRAM are handed on and take their place;
///  3. each bank takes requests that have waited, the first ones, as many as it has ports;
///  4. requests that arrive now, of the lowest requester first, are taken by their bank if a port
///     is left and nothing waits before them, or queue.
///
/// With a crossbar they arrive when they have crossed it; so do answers, before 3.
///
/// A bank takes nothing while its first request waits for room in the MSHRs, or its write buffer is
/// full. A request to DRAM leaves hit_latency after the look-up that caused it, or the fill that
/// pushed a modified line out.
class L2Cache {
 public:
  L2Cache(const L2Spec& spec, const CrossbarSpec& crossbar, Dram& dram);

  std::vector<Link<LineRequest>*> in_requests;     ///< by requester
  std::vector<Link<LineResponse>*> out_responses;  ///< by requester

  void tick(Cycles now);

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
  /// Whether it will go on by itself.
  [[nodiscard]] bool is_moving() const;

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
    std::deque<Request> queue;
    std::vector<Mshr> mshrs;
    std::uint32_t ports_taken = 0;  ///< in this cycle
    std::uint32_t writes_out = 0;   ///< under way to DRAM, of a bounded write buffer
    bool blocked = false;           ///< its first request waits for an MSHR
  };
  /// A line as its bank sees it.
  struct Place {
    Bank& bank;
    std::uint64_t index = 0;
  };

  void take_answers(Cycles now);
  void fill(Address address, Cycles now);
  void put(std::uint64_t line, bool dirty, Cycles now);
  void take_requests(Cycles now);
  void accept(const LineRequest& request, Cycles now);
  void respond(const LineRequest& request, Cycles now);
  void send(const LineRequest& request, Cycles now);
  [[nodiscard]] bool can_take(const Bank& bank) const;
  bool serve(Bank& bank, const Request& request, Cycles now);
  bool serve_read(Bank& bank, const LineRequest& request, Cycles now);
  bool serve_write(Bank& bank, const LineRequest& request, Cycles now);
  bool write_missing(Bank& bank, const LineRequest& request, Cycles now);
  Mshr* find_mshr(Bank& bank, std::uint64_t line);
  Mshr& take_mshr(Bank& bank, const LineRequest& request, Cycles now);
  bool wait_for_room(Bank& bank, std::uint64_t& counter);
  void count_hit(const LineRequest& request);
  void pass_on(const LineRequest& request, Cycles now);
  void send_to_dram(Address address, Bytes bytes, bool write, Cycles now);

  [[nodiscard]] Bytes line_size() const { return spec_.line / spec_.sectors; }
  [[nodiscard]] std::uint64_t line_of(Address address) const { return address / line_size(); }
  [[nodiscard]] Place place_of(std::uint64_t line);
  L2KindStats& kind_of(const LineRequest& request) {
    return kind_stats_[static_cast<std::size_t>(request.kind)];
  }

  [[nodiscard]] std::size_t bank_number(std::uint64_t line) const {
    return line / spec_.sectors % spec_.banks;
  }

  const L2Spec spec_;
  const CrossbarSpec crossbar_;
  Dram& dram_;
  std::vector<Bank> banks_;
  Link<LineRequest> answered_;  ///< hits and taken writes, on their way through the arrays
  std::optional<RequestCrossbar> request_crossbar_;
  std::optional<ResponseCrossbar> response_crossbar_;
  L2Stats stats_;
  std::array<L2KindStats, kNumDataKinds> kind_stats_;
};

}  // namespace sheaf::clocked
