// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "memory/banked_dram.h"
#include "report/perfetto_writer.h"
#include "report/watch_window.h"

namespace sheaf {

/// The part of a timeline that shows a memory's banks: the rows they hold open, refreshes by rank,
/// bursts by channel. Commands are told later than they happen, so each track is in order of time,
/// but not with the others. What overlaps a recorded stretch is shown whole, up to the window's
/// ends.
class DramTracks {
 public:
  DramTracks(BankedDram& dram, PerfettoWriter& writer, const WatchWindow& window);
  DramTracks(const DramTracks&) = delete;
  DramTracks& operator=(const DramTracks&) = delete;

  /// Rows that are open still are shown up to there, and nothing from then on.
  void finish(Cycles end);

 private:
  using Track = PerfettoWriter::Track;
  struct Bank {
    Track track = 0;
    std::optional<Cycles> open_since;
    std::uint32_t row = 0;
  };
  struct Channel {
    std::vector<Bank> banks;
    std::vector<Track> ranks;
    Track bus = 0;
  };
  void add_channel(std::size_t number);
  void see(Channel& channel, const IssuedCommand& command);
  void close(Bank& bank, Cycles at);
  void show(Track track, Cycles from, Cycles to, std::string_view name);
  [[nodiscard]] Bank& bank_of(Channel& channel, const IssuedCommand& command);

  BankedDram& dram_;
  PerfettoWriter& writer_;
  const WatchWindow window_;
  Track top_ = 0;
  std::vector<Channel> channels_;
  bool finished_ = false;
};

}  // namespace sheaf
