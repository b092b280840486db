// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/units.h"
#include "config/dram/device.h"
#include "memory/dram/channel.h"

namespace sheaf {

/// All channels of a memory. A request for any number of bytes is cut into bursts; those that lie
/// together in a row are one request of a channel. It is done when the last of them is. All times
/// are in tCK.
class DramSystem {
 public:
  explicit DramSystem(const DramDevice& device);

  struct Request {
    Cycles arrival = 0;
    Address address = 0;
    Bytes bytes = 0;  ///< at least 1
    bool write = false;
    std::uint64_t id = 0;  ///< given back with the completion, as is the next
    void* user = nullptr;
  };
  struct Done {
    std::uint64_t id = 0;
    void* user = nullptr;
    bool write = false;
    Cycles arrival = 0;
    Cycles accepted = 0;  ///< into the queue; of several parts the first
    Cycles at = 0;        ///< last byte on the data bus
  };

  /// Arrivals come in order of time, none before a cycle that advance() has passed.
  void push(const Request& request);

  /// Does all that happens before cycle `until` (kNever: until nothing is left to do) and calls
  /// f(const Done&) for every request that is then known to be done, which may be later than
  /// `until`: data come a fixed time after their column command.
  template <typename F>
  void advance(Cycles until, F&& f) {
    for (auto& channel : channels_) channel->advance(until, parts_done_);
    hand_on(f);
  }
  /// Goes on until at most so many requests wait for room in the queue of any channel; for whoever
  /// pushes faster than the memory serves.
  template <typename F>
  void relieve(std::size_t waiting, F&& f) {
    for (auto& channel : channels_) channel->relieve(waiting, parts_done_);
    hand_on(f);
  }

  [[nodiscard]] Cycles next_event() const;
  [[nodiscard]] bool is_idle() const { return free_.size() == pending_.size(); }
  /// Requests that no queue had room for yet, in the channel that has most of them.
  [[nodiscard]] std::size_t num_waiting() const;

  [[nodiscard]] const DramDevice& device() const { return device_; }
  [[nodiscard]] std::size_t num_channels() const { return channels_.size(); }
  [[nodiscard]] DramChannel& channel(std::size_t i) { return *channels_[i]; }
  /// The last command or acceptance of any channel.
  [[nodiscard]] Cycles now() const;
  /// Over all channels, as of cycle `end`.
  [[nodiscard]] DramChannelStats stats(Cycles end) const;

 private:
  struct Pending {
    Done done;
    std::uint32_t parts_left = 0;
  };

  template <typename F>
  void hand_on(F&& f) {
    for (const DramDone& part : parts_done_) {
      Pending& pending = pending_[part.tag];
      pending.done.at = std::max(pending.done.at, part.at);
      pending.done.accepted = std::min(pending.done.accepted, part.accepted);
      if (--pending.parts_left != 0) continue;
      f(pending.done);
      free_.push_back(part.tag);
    }
    parts_done_.clear();
  }

  const DramDevice device_;
  std::vector<std::unique_ptr<DramChannel>> channels_;
  std::vector<Pending> pending_;
  std::vector<std::uint32_t> free_;
  std::vector<DramDone> parts_done_;
};

}  // namespace sheaf
