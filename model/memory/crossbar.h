// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <queue>
#include <vector>

#include "base/units.h"
#include "config/config.h"
#include "memory/memory_messages.h"
#include "stats/counters.h"

namespace sheaf {

#define SHEAF_REQUEST_CROSSBAR_COUNTERS(X)                                              \
  X(num_requests, "requests", "Requests that crossed to a bank of the L2")              \
  X(busy_cycles, "cycles", "Cycles in which bank inputs were taken, summed over banks") \
  X(wait_cycles, "cycles", "Cycles that requests waited before they crossed, summed")   \
  X(occupancy_cycles, "cycles", "Requests waiting to cross, summed over all cycles")    \
  X(max_waiting, "requests", "Most requests waiting to cross at a time")
SHEAF_STATS(RequestCrossbarStats, SHEAF_REQUEST_CROSSBAR_COUNTERS);

#define SHEAF_RESPONSE_CROSSBAR_COUNTERS(X)                                              \
  X(num_lines, "lines", "Lines that crossed to a private cache")                         \
  X(busy_cycles, "cycles", "Cycles in which bank outputs were taken, summed over banks") \
  X(wait_cycles, "cycles", "Cycles that lines waited for their bank's output, summed")
SHEAF_STATS(ResponseCrossbarStats, SHEAF_RESPONSE_CROSSBAR_COUNTERS);

/// Way of requests from private caches to banks: a queue a cache, of which only the first goes on.
/// A request goes when its cache's port and its bank's are free and the bank has room for it; of
/// several for one bank the oldest, then that of the lowest cache. A read takes both ports for a
/// cycle, a write for as long as its data take. Knows no time but what it is told, which must not
/// go back.
class RequestCrossbar {
 public:
  RequestCrossbar(const CrossbarSpec& spec, std::size_t caches, std::size_t banks)
      : spec_(spec), caches_(caches), bank_free_(banks), chosen_(banks) {}

  struct Entry {
    LineRequest request;
    std::size_t bank = 0;
    Cycles arrival = 0;
  };
  void push(const LineRequest& request, std::size_t bank, Cycles now);

  /// Calls deliver(bank, request) for all that cross at `now`; has_room(bank): whether one more
  /// may.
  template <typename HasRoom, typename Deliver>
  void cross(Cycles now, const HasRoom& has_room, const Deliver& deliver) {
    if (num_waiting_ == 0) return;
    choose(now, has_room);
    for (std::size_t bank = 0; bank < chosen_.size(); ++bank) {
      if (chosen_[bank] != nullptr) deliver(bank, take(*chosen_[bank], now));
    }
  }
  /// When the next request can cross if its bank has room.
  template <typename HasRoom>
  [[nodiscard]] Cycles next_event(const HasRoom& has_room) const {
    Cycles next = kNever;
    if (num_waiting_ == 0) return next;
    for (const Cache& cache : caches_) {
      if (cache.queue.empty() || !has_room(cache.queue.front().bank)) continue;
      next = std::min(next, std::max(cache.free_at, bank_free_[cache.queue.front().bank]));
    }
    return next;
  }
  [[nodiscard]] std::size_t num_waiting() const { return num_waiting_; }
  [[nodiscard]] const RequestCrossbarStats& stats() const { return stats_; }

 private:
  struct Cache {
    std::deque<Entry> queue;
    Cycles free_at = 0;
  };
  template <typename HasRoom>
  void choose(Cycles now, const HasRoom& has_room) {
    std::fill(chosen_.begin(), chosen_.end(), nullptr);
    for (Cache& cache : caches_) {
      if (cache.queue.empty() || cache.free_at > now) continue;
      const Entry& first = cache.queue.front();
      if (bank_free_[first.bank] > now || !has_room(first.bank)) continue;
      Cache*& best = chosen_[first.bank];
      if (best == nullptr || first.arrival < best->queue.front().arrival) best = &cache;
    }
  }
  LineRequest take(Cache& cache, Cycles now);
  void count_occupancy(Cycles now);

  const CrossbarSpec spec_;
  std::vector<Cache> caches_;
  std::vector<Cycles> bank_free_;
  std::vector<Cache*> chosen_;  ///< a bank: whose first request crosses
  std::size_t num_waiting_ = 0;
  Cycles counted_until_ = 0;
  RequestCrossbarStats stats_;
};

/// Way of lines from banks to private caches: a bank's lines leave one after the other, in the
/// order in which they are ready. That a write was taken holds nothing up and waits for nothing.
class ResponseCrossbar {
 public:
  ResponseCrossbar(const CrossbarSpec& spec, std::size_t banks) : spec_(spec), banks_(banks) {}

  struct Entry {
    Cycles ready = 0;
    std::uint64_t rank = 0;  ///< of equal times the lower first
    std::size_t bank = 0;
    LineRequest request;
    bool operator>(const Entry& other) const {
      return ready != other.ready ? ready > other.ready : rank > other.rank;
    }
  };
  void push(std::size_t bank, const LineRequest& request, Cycles ready) {
    waiting_.push({ready, num_pushed_++, bank, request});
  }
  [[nodiscard]] Cycles next_event() const {
    return waiting_.empty() ? kNever : waiting_.top().ready;
  }
  /// Calls deliver(request, start) for all answers that are ready by `now`; they leave at `start`.
  template <typename Deliver>
  void cross(Cycles now, const Deliver& deliver) {
    while (!waiting_.empty() && waiting_.top().ready <= now) {
      const Entry entry = waiting_.top();
      waiting_.pop();
      deliver(entry.request, leave(entry));
    }
  }
  [[nodiscard]] bool is_empty() const { return waiting_.empty(); }
  [[nodiscard]] const ResponseCrossbarStats& stats() const { return stats_; }

 private:
  Cycles leave(const Entry& entry);

  const CrossbarSpec spec_;
  std::vector<Cycles> banks_;  ///< when their output is free
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;
  std::uint64_t num_pushed_ = 0;
  ResponseCrossbarStats stats_;
};

}  // namespace sheaf
