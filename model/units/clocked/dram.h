// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <set>
#include <string>
#include <utility>

#include "base/object_pool.h"
#include "config/config.h"
#include "memory/dram/clock_ratio.h"
#include "memory/dram/dram_system.h"
#include "memory/main_memory.h"
#include "units/clocked/link.h"

namespace sheaf::clocked {

struct DramRequest {
  Address address = 0;
  Bytes bytes = 0;
  bool write = false;
};

/// What stands behind the L2, and answers what it is asked.
class Dram {
 public:
  /// `request_latency`: from the L2's look-up to the memory.
  explicit Dram(Cycles request_latency)
      : requests("requests", {.latency = request_latency, .interval = 0}) {}
  virtual ~Dram() = default;

  Link<DramRequest> requests;

  virtual void tick(Cycles now) = 0;
  /// No request is on its way or being served.
  [[nodiscard]] virtual bool is_idle() const = 0;

  /// A line that has been read, or a write that has been done.
  struct Answer {
    Cycles at = 0;
    Address address = 0;
    bool write = false;
    auto operator<=>(const Answer&) const = default;
  };
  [[nodiscard]] bool has_answer(Cycles now) const {
    return !answers_.empty() && answers_.begin()->at <= now;
  }
  /// The one that came first, of those of a cycle the one of the lowest address.
  Answer take_answer();

  /// In core cycles, as of core cycle `end`.
  [[nodiscard]] virtual DramStats stats(Cycles end) const = 0;
  /// What only this kind of memory counts, below `path`.
  virtual void report_details(const std::string& path, Cycles end, StatsTree& stats) const = 0;

 protected:
  void count_request(const DramRequest& request);
  /// All bytes of a request that came at cycle `asked` have been moved at cycle `at`.
  void complete(const DramRequest& request, Cycles asked, Cycles at);

  DramStats stats_;

 private:
  std::multiset<Answer> answers_;
};

/// Data flows `latency` after the request, or when the bus is free.
class FixedDram final : public Dram {
 public:
  FixedDram(Cycles request_latency, DramSpec spec)
      : Dram(request_latency), spec_(std::move(spec)) {}
  void tick(Cycles now) override;
  [[nodiscard]] bool is_idle() const override { return requests.size() == 0; }
  [[nodiscard]] DramStats stats(Cycles /*end*/) const override { return stats_; }
  void report_details(const std::string& /*path*/, Cycles /*end*/,
                      StatsTree& /*stats*/) const override {}

 private:
  const DramSpec spec_;
  Cycles bus_free_ = 0;
};

/// Channels, banks and rows: the command scheduler that `timed` uses too, advanced by one core
/// cycle a tick.
class BankedDram final : public Dram {
 public:
  /// `core_hz`: frequency of the core clock.
  BankedDram(Cycles request_latency, const DramDevice& device, double core_hz);
  void tick(Cycles now) override;
  [[nodiscard]] bool is_idle() const override { return requests.size() == 0 && memory_.is_idle(); }
  [[nodiscard]] DramStats stats(Cycles end) const override;
  void report_details(const std::string& path, Cycles end, StatsTree& stats) const override;

 private:
  [[nodiscard]] Cycles memory_end(Cycles end) const;

  struct Served {
    DramRequest request;
    Cycles asked = 0;
  };
  DramSystem memory_;
  const ClockRatio to_memory_, to_core_;
  ObjectPool<Served> served_;
};

}  // namespace sheaf::clocked
