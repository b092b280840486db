// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

#include "base/units.h"
#include "config/dram/device.h"
#include "memory/dram/bank_timing.h"
#include "memory/dram/channel_stats.h"
#include "memory/dram/commands.h"
#include "memory/dram/request_queue.h"
#include "memory/dram/scheduler.h"

namespace sheaf {

/// A request's last byte is (or would be) on the data bus.
struct DramDone {
  std::uint32_t tag = 0;
  Cycles accepted = 0;
  Cycles at = 0;
};

/// One channel with its controller: takes requests in order of arrival into a queue of reads and
/// one of writes, issues the commands that DramScheduler chooses, and refreshes. All times are in
/// tCK.
///
/// A read of a queued write is answered from the queue, a write of a queued write replaces it.
/// Every tREFI a rank takes no more commands of requests, is precharged and refreshed.
///
/// Nothing is done per cycle: time goes from one command or acceptance to the next.
class DramChannel {
 public:
  explicit DramChannel(const DramDevice& device);
  DramChannel(const DramChannel&) = delete;
  DramChannel& operator=(const DramChannel&) = delete;

  /// Arrivals come in order of time, none before a cycle that advance() has passed unless others
  /// wait: a request is not taken before those that came before it.
  void push(const DramRequest& request) { input_.push_back(request); }

  /// Does all that happens before cycle `until`; kNever: until nothing is left to do. Completions
  /// are added to `done`, in order of their column commands.
  void advance(Cycles until, std::vector<DramDone>& done);

  /// Goes on until at most so many requests wait to be taken.
  void relieve(std::size_t waiting, std::vector<DramDone>& done);

  /// No request can be taken and no command for one be issued before this cycle; kNever: nothing to
  /// do but refreshes.
  [[nodiscard]] Cycles next_event();

  [[nodiscard]] std::size_t num_waiting() const { return input_.size(); }
  [[nodiscard]] std::size_t num_queued() const { return reads_.size() + writes_.size(); }
  [[nodiscard]] bool is_idle() const { return input_.empty() && num_queued() == 0; }
  /// Counters as of cycle `end`, which is not before the last command.
  [[nodiscard]] DramChannelStats stats(Cycles end) const;
  /// The cycle of the last command or acceptance.
  [[nodiscard]] Cycles now() const { return now_; }
  void watch(std::function<void(const IssuedCommand&)> watcher) { watcher_ = std::move(watcher); }

 private:
  using Choice = DramScheduler::Choice;
  [[nodiscard]] const Choice& choose();
  void consider_refreshes(Choice& best) const;
  void step(Cycles acceptance, std::vector<DramDone>& done);
  void skip_idle_refreshes(Cycles until);
  [[nodiscard]] Cycles next_acceptance() const;
  void accept(Cycles now, std::vector<DramDone>& done);
  void issue(const Choice& choice, std::vector<DramDone>& done);
  void issue_column(const Choice& choice, std::vector<DramDone>& done);
  void count_outcome(BankTiming::Bank& bank);
  void count_occupancy(Cycles now);
  [[nodiscard]] DramScheduler::Buses buses() const {
    return {std::max(row_bus_at_, now_), std::max(column_bus_at_, now_)};
  }
  [[nodiscard]] BankLists& queue() { return scheduler_.writing() ? writes_ : reads_; }
  void report(const Choice& choice, DramCommand command);

  const DramDevice device_;
  BankTiming banks_;
  std::deque<DramRequest> input_;
  BankLists reads_, writes_;
  DramScheduler scheduler_;
  Choice choice_;  ///< the next command, while choice_valid_
  bool choice_valid_ = false;
  std::vector<Cycles> refresh_at_;  ///< a rank: when its next refresh is due
  bool wrote_last_ = false;
  bool moved_data_ = false;
  Cycles row_bus_at_ = 0, column_bus_at_ = 0;  ///< first free cycle of the command bus
  Cycles now_ = 0;
  Cycles counted_until_ = 0;  ///< of queue_occupancy_cycles
  std::uint64_t num_accepted_ = 0;
  DramChannelStats stats_;
  std::function<void(const IssuedCommand&)> watcher_;
};

}  // namespace sheaf
