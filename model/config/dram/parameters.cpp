// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/dram/parameters.h"

#include "config/dram/presets.h"

namespace sheaf {

void declare_dram(ParameterTable& t, DramSpec& dram) {
  std::vector<std::pair<std::string, DramModel>> models{{"fixed", DramModel::kFixed}};
  for (const DramPreset& preset : dram_presets()) {
    models.emplace_back(std::string(preset.name), preset.model);
  }
  t.choice(
      "dram.model", dram.model, DramModel::kFixed, std::move(models),
      "Memory behind the L2: fixed latency and bandwidth, or channels, banks and rows with the "
      "timing of a standard, for which the dram.* below give the rest");
  t.count("dram.latency", dram.latency, 100, 1, kMaxLatency, "cycles",
          "Fixed model: from a request's arrival to its first data, unloaded");
  t.bytes("dram.bytes_per_cycle", dram.bytes_per_cycle, 16, 1, 65536,
          "Fixed model: bytes of bandwidth per core cycle");
  t.count("dram.channels", dram.channels, 0, 0, 64, "channels",
          "Independent channels, a power of two; 0 = as the preset has it");
  t.count("dram.ranks", dram.ranks, 0, 0, 16, "ranks",
          "Ranks of a channel, a power of two; 0 = as the preset has it");
  t.text("dram.mapping", dram.mapping, "",
         "Fields of an address above the byte in a burst, most significant first, in pieces where "
         "wanted, as in 'row rank bank bankgroup column:5 channel column:2'; empty = the preset's");
  t.choice(
      "dram.page", dram.page, PagePolicy::kOpen,
      {{"open", PagePolicy::kOpen}, {"closed", PagePolicy::kClosed}},
      "A row stays open until another one is needed, or is closed after the last queued access "
      "to it");
  t.count("dram.read_queue", dram.read_queue, 32, 1, 1024, "requests", "Reads queued in a channel");
  t.count("dram.write_queue", dram.write_queue, 32, 1, 1024, "requests",
          "Writes queued in a channel");
  t.count("dram.write_high", dram.write_high, 24, 1, 1024, "requests",
          "Queued writes at which they go before reads");
  t.count("dram.write_low", dram.write_low, 8, 0, 1023, "requests",
          "Queued writes at which reads go first again");
  t.count("dram.row_hit_cap", dram.row_hit_cap, 16, 0, kMaxLatency, "requests",
          "Row hits that may overtake an older request to the same bank before its row is opened; "
          "0 = any number");
  t.count("dram.controller_latency", dram.controller_latency, 1, 0, kMaxLatency, "tCK",
          "From a request's acceptance to its first command at the earliest");
  t.flag("dram.refresh", dram.refresh, true, "Refresh all banks of a rank every tREFI");
#define SHEAF_DRAM_TIMING_PARAMETER(name, meaning)                   \
  t.count("dram." #name, dram.timing.name, 0, 0, kMaxLatency, "tCK", \
          meaning "; 0 = as the preset has it");
  SHEAF_DRAM_TIMINGS(SHEAF_DRAM_TIMING_PARAMETER)
#undef SHEAF_DRAM_TIMING_PARAMETER
}

}  // namespace sheaf
