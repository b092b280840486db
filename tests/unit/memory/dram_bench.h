// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "config/parameters.h"
#include "memory/dram/channel.h"
#include "memory/dram/stream.h"

namespace sheaf {

// For the names of tests.
inline void PrintTo(DramModel model, std::ostream* out) {
  *out << to_string(model);
}
inline void PrintTo(PagePolicy page, std::ostream* out) {
  *out << (page == PagePolicy::kOpen ? "open" : "closed");
}
inline void PrintTo(StreamKind kind, std::ostream* out) {
  *out << (kind == StreamKind::kSequential ? "sequential"
           : kind == StreamKind::kRandom   ? "random"
                                           : "interleaved");
}

}  // namespace sheaf

namespace sheaf::test {

/// The defaults of dram.* for DDR4-2400.
inline DramSpec ddr4_spec() {
  Config config;
  static_cast<void>(declare_parameters(config));
  config.dram.model = DramModel::kDdr4_2400;
  return config.dram;
}

using Change = std::function<void(DramSpec&)>;

inline DramDevice ddr4(const Change& change = {}) {
  DramSpec spec = ddr4_spec();
  if (change) change(spec);
  return resolve_dram(spec);
}

/// One channel, driven by hand; remembers every command.
class ChannelBench {
 public:
  explicit ChannelBench(const DramDevice& device) : device_(device), channel_(device) {
    channel_.watch([this](const IssuedCommand& command) { commands_.push_back(command); });
  }
  struct Place {
    std::uint32_t group = 0, bank = 0, row = 0, column = 0, rank = 0;
  };
  ChannelBench& read(Cycles arrival, const Place& place) { return request(arrival, place, false); }
  ChannelBench& write(Cycles arrival, const Place& place) { return request(arrival, place, true); }
  ChannelBench& run() {
    channel_.advance(kNever, done_);
    return *this;
  }

  /// Time of the n-th command of this kind.
  [[nodiscard]] Cycles at(DramCommand kind, std::size_t n = 0) const {
    for (const IssuedCommand& command : commands_) {
      if (command.command == kind && n-- == 0) return command.at;
    }
    return kNever;
  }
  [[nodiscard]] const std::vector<IssuedCommand>& commands() const { return commands_; }
  [[nodiscard]] const std::vector<DramDone>& done() const { return done_; }
  /// When the n-th request (in order of arrival) was done.
  [[nodiscard]] Cycles done_at(std::uint32_t n) const {
    for (const DramDone& done : done_) {
      if (done.tag == n) return done.at;
    }
    return kNever;
  }
  [[nodiscard]] DramChannel& channel() { return channel_; }
  [[nodiscard]] DramChannelStats stats() const { return channel_.stats(channel_.now()); }

 private:
  ChannelBench& request(Cycles arrival, const Place& place, bool write) {
    const DramOrganization& o = device_.organization;
    channel_.push({.arrival = arrival,
                   .tag = num_requests_++,
                   .bank = (place.rank * o.bank_groups + place.group) * o.banks + place.bank,
                   .row = place.row,
                   .column = place.column,
                   .bursts = 1,
                   .write = write});
    return *this;
  }

  const DramDevice device_;
  DramChannel channel_;
  std::vector<IssuedCommand> commands_;
  std::vector<DramDone> done_;
  std::uint32_t num_requests_ = 0;
};

}  // namespace sheaf::test
