// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "config/dram/device.h"

namespace sheaf::test {

/// A controller that looks at every request in every cycle, of reads, one channel and one rank:
/// slow and simple, to compare with. The oldest of the requests whose next command may be issued
/// goes first; a row that was opened for a request is not closed before that has been read. From
/// the time at which a refresh is due nothing else is done until it has begun.
class CycleController {
 public:
  explicit CycleController(const DramDevice& device) : device_(device), t_(device.timing) {}

  struct Result {
    std::uint64_t sum_latency = 0;  ///< acceptance to last byte
    std::uint64_t num_row_hits = 0;
    Cycles end = 0;  ///< last byte
  };
  /// Reads of these places, a request at most a cycle, `gap` cycles apart.
  Result run(const std::vector<DramLocation>& places, Cycles gap) {
    Result result;
    std::size_t next = 0;
    for (Cycles now = 0; next < places.size() || !queue_.empty(); ++now) {
      step(now, result);
      if (next < places.size() && next * gap <= now && queue_.size() < device_.read_queue) {
        queue_.push_back({places[next++], now});
      }
    }
    return result;
  }

 private:
  enum class Step { kRead, kActivate, kPrecharge };
  struct Request {
    DramLocation where;
    Cycles accepted = 0;
    bool opened = false;  ///< its row was opened for it, or another closed
    bool owns_row = false;
  };
  struct Bank {
    bool open = false;
    std::uint32_t row = 0;
    Cycles read_at = 0, activate_at = 0, precharge_at = 0;
  };
  Bank& bank_of(const Request& r) {
    return banks_[r.where.bank_group * device_.organization.banks + r.where.bank];
  }
  Step step_of(const Request& r) {
    const Bank& bank = bank_of(r);
    if (!bank.open) return Step::kActivate;
    return bank.row == r.where.row ? Step::kRead : Step::kPrecharge;
  }
  bool is_ready(const Request& r, Cycles now) {
    const Bank& bank = bank_of(r);
    const std::uint32_t group = r.where.bank_group;
    switch (step_of(r)) {
      case Step::kRead:
        return now >= std::max({bank.read_at, group_read_at_[group], read_at_});
      case Step::kActivate:
        return now >= std::max({bank.activate_at, group_activate_at_[group], activate_at_,
                                window_[oldest_activation_]});
      default:
        return now >= bank.precharge_at && std::none_of(queue_.begin(), queue_.end(), [&](auto& q) {
                 return q.owns_row && &bank_of(q) == &bank;
               });
    }
  }
  void step(Cycles now, Result& result) {
    if (now >= refresh_at_ && device_.refresh) {
      refresh(now);
      return;
    }
    auto best = queue_.end();
    for (auto r = queue_.begin(); r != queue_.end(); ++r) {
      if (!is_ready(*r, now)) continue;
      const bool better =
          best == queue_.end() || (step_of(*r) == Step::kRead && step_of(*best) != Step::kRead);
      if (better) best = r;
    }
    if (best != queue_.end()) issue(best, now, result);
  }
  void issue(std::vector<Request>::iterator r, Cycles now, Result& result) {
    Bank& bank = bank_of(*r);
    const std::uint32_t group = r->where.bank_group;
    switch (step_of(*r)) {
      case Step::kRead:
        if (!r->opened) ++result.num_row_hits;
        bank.precharge_at = std::max(bank.precharge_at, now + t_.tRTP);
        group_read_at_[group] = now + t_.tCCD_L;
        read_at_ = now + t_.tCCD_S;
        result.end = now + t_.tCL + t_.tBL;
        result.sum_latency += result.end - r->accepted;
        queue_.erase(r);
        return;
      case Step::kActivate:
        bank = {true, r->where.row, now + t_.tRCD, now + t_.tRC, now + t_.tRAS};
        group_activate_at_[group] = now + t_.tRRD_L;
        activate_at_ = now + t_.tRRD_S;
        window_[oldest_activation_] = now + t_.tFAW;
        oldest_activation_ = (oldest_activation_ + 1) % window_.size();
        r->opened = r->owns_row = true;
        return;
      default:
        bank.open = false;
        bank.activate_at = std::max(bank.activate_at, now + t_.tRP);
        r->opened = true;
    }
  }
  // Closes all rows at once as soon as that may be, then refreshes.
  void refresh(Cycles now) {
    bool any_open = false;
    Cycles precharge_at = 0, ready_at = 0;
    for (const Bank& bank : banks_) {
      any_open |= bank.open;
      precharge_at = std::max(precharge_at, bank.precharge_at);
      ready_at = std::max(ready_at, bank.activate_at);
    }
    if (any_open && now >= precharge_at) {
      for (Bank& bank : banks_) {
        if (bank.open) bank.activate_at = std::max(bank.activate_at, now + t_.tRP);
        bank.open = false;
      }
      for (Request& r : queue_) r.owns_row = false;
    } else if (!any_open && now >= ready_at) {
      for (Bank& bank : banks_) bank.activate_at = now + t_.tRFC;
      refresh_at_ += t_.tREFI;
    }
  }

  const DramDevice device_;
  const DramTiming t_;
  std::vector<Request> queue_;
  std::vector<Bank> banks_ = std::vector<Bank>(device_.organization.banks_per_rank());
  std::vector<Cycles> group_read_at_ = std::vector<Cycles>(device_.organization.bank_groups);
  std::vector<Cycles> group_activate_at_ = std::vector<Cycles>(device_.organization.bank_groups);
  std::array<Cycles, 4> window_{};
  std::size_t oldest_activation_ = 0;
  Cycles read_at_ = 0, activate_at_ = 0;
  Cycles refresh_at_ = t_.tREFI;
};

}  // namespace sheaf::test
