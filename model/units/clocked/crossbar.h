// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <list>
#include <vector>

#include "config/config.h"
#include "memory/crossbar.h"
#include "memory/memory_messages.h"

namespace sheaf::clocked {

/// Way of requests from private caches to banks of the L2: a queue a cache, of which only the first
/// goes on, when its cache's port and its bank's are free and the bank has room. Of several for one
/// bank the oldest goes, then that of the lowest cache. A read takes both ports for a cycle, a
/// write for as long as its data take.
class RequestCrossbar {
 public:
  RequestCrossbar(const CrossbarSpec& spec, std::size_t banks) : spec_(spec), banks_(banks, 0) {}

  void push(const LineRequest& request, std::size_t bank, Cycles now);

  using HasRoom = std::function<bool(std::size_t bank)>;
  /// The requests that cross in this cycle, by bank, no more than one for each.
  std::vector<LineRequest> cross(const HasRoom& has_room, Cycles now);

  [[nodiscard]] bool is_empty() const { return num_waiting_ == 0; }
  [[nodiscard]] const RequestCrossbarStats& stats() const { return stats_; }

 private:
  struct Entry {
    LineRequest request;
    std::size_t bank = 0;
    Cycles arrival = 0;
  };
  struct Cache {
    std::deque<Entry> queue;
    Cycles free_at = 0;
  };
  Cache* choose(std::size_t bank, Cycles now);

  const CrossbarSpec spec_;
  std::vector<Cache> caches_;
  std::vector<Cycles> banks_;  ///< when their port is free
  std::uint64_t num_waiting_ = 0;
  RequestCrossbarStats stats_;
};

/// Way of lines from banks to private caches: a bank's lines leave one after the other, in the
/// order in which they are ready, each for as long as its bytes take. That a write was taken holds
/// nothing up and waits for nothing.
class ResponseCrossbar {
 public:
  ResponseCrossbar(const CrossbarSpec& spec, std::size_t banks) : spec_(spec), banks_(banks, 0) {}

  /// An answer that is ready now.
  void push(const LineRequest& request, std::size_t bank, Cycles now) {
    waiting_.push_back({request, bank, now});
  }
  /// Those that leave in this cycle, in the order in which they were ready.
  std::vector<LineRequest> cross(Cycles now);

  [[nodiscard]] bool is_empty() const { return waiting_.empty(); }
  [[nodiscard]] const ResponseCrossbarStats& stats() const { return stats_; }

 private:
  struct Entry {
    LineRequest request;
    std::size_t bank = 0;
    Cycles ready = 0;
  };
  bool leaves(const Entry& entry, Cycles now);

  const CrossbarSpec spec_;
  std::vector<Cycles> banks_;  ///< when their output is free
  std::list<Entry> waiting_;
  ResponseCrossbarStats stats_;
};

}  // namespace sheaf::clocked
