// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/dram_tracks.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

DramTracks::DramTracks(BankedDram& dram, PerfettoWriter& writer, const WatchWindow& window)
    : dram_(dram), writer_(writer), window_(window) {
  top_ = writer_.add_track("dram", PerfettoWriter::kTop);
  const std::size_t num_channels = dram.device().organization.channels;
  channels_.resize(num_channels);
  for (std::size_t i = 0; i < num_channels; ++i) add_channel(i);
}

void DramTracks::add_channel(std::size_t number) {
  const DramOrganization& o = dram_.device().organization;
  Channel& channel = channels_[number];
  channel.bus = writer_.add_track(fmt::format("channel {} data bus", number), top_);
  for (std::uint32_t rank = 0; rank < o.ranks; ++rank) {
    channel.ranks.push_back(
        writer_.add_track(fmt::format("channel {} rank {} refresh", number, rank), top_));
    for (std::uint32_t i = 0; i < o.banks_per_rank(); ++i) {
      channel.banks.push_back(
          {writer_.add_track(fmt::format("channel {} rank {} group {} bank {}", number, rank,
                                         i / o.banks, i % o.banks),
                             top_),
           {},
           0});
    }
  }
  dram_.watch(number, [this, &channel](const IssuedCommand& command) { see(channel, command); });
}

DramTracks::Bank& DramTracks::bank_of(Channel& channel, const IssuedCommand& command) {
  const DramOrganization& o = dram_.device().organization;
  return channel
      .banks[command.rank * o.banks_per_rank() + command.bank_group * o.banks + command.bank];
}

void DramTracks::see(Channel& channel, const IssuedCommand& command) {
  if (finished_) return;
  const DramTiming& t = dram_.device().timing;
  const Cycles at = dram_.to_core(command.at);
  const auto burst = [&](const char* name, std::uint32_t latency) {
    show(channel.bus, dram_.to_core(command.at + latency),
         dram_.to_core(command.at + latency + t.tBL), name);
  };
  switch (command.command) {
    case DramCommand::kActivate: {
      Bank& bank = bank_of(channel, command);
      bank.open_since = at;
      bank.row = command.row;
      return;
    }
    case DramCommand::kPrecharge:
      return close(bank_of(channel, command), at);
    case DramCommand::kPrechargeAll: {
      const std::size_t banks = dram_.device().organization.banks_per_rank();
      for (std::size_t i = 0; i < banks; ++i) close(channel.banks[command.rank * banks + i], at);
      return;
    }
    case DramCommand::kRead:
      return burst("read", t.tCL);
    case DramCommand::kWrite:
      return burst("write", t.tCWL);
    case DramCommand::kReadPrecharge:
      burst("read", t.tCL);
      return close(bank_of(channel, command), at);
    case DramCommand::kWritePrecharge:
      burst("write", t.tCWL);
      return close(bank_of(channel, command), at);
    case DramCommand::kRefresh:
      return show(channel.ranks[command.rank], at, dram_.to_core(command.at + t.tRFC), "refresh");
  }
}

void DramTracks::close(Bank& bank, Cycles at) {
  if (!bank.open_since) return;
  show(bank.track, *bank.open_since, at, fmt::format("row {}", bank.row));
  bank.open_since.reset();
}

void DramTracks::show(Track track, Cycles from, Cycles to, std::string_view name) {
  const Cycles first = window_.next(from);
  if (first >= to || writer_.num_events() >= window_.max_events) return;
  writer_.begin(track, std::max(from, window_.begin), name);
  writer_.end(track, std::min(to, window_.end));
}

void DramTracks::finish(Cycles end) {
  for (Channel& channel : channels_) {
    for (Bank& bank : channel.banks) close(bank, std::max(end, bank.open_since.value_or(0)));
  }
  finished_ = true;
}

}  // namespace sheaf
