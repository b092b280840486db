// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "memory/dram/energy.h"
#include "memory/dram/trace_run.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

double item(const std::vector<DramEnergyItem>& items, std::string_view name) {
  for (const DramEnergyItem& one : items) {
    if (one.what.name == name) return one.picojoule.value_or(-1);
  }
  return -2;
}

// 8 devices at 1.2 V, tCK 0.8333 ns, currents in mA, by hand.
TEST(DramEnergy, CommandsCostWhatTheirCurrentsExceedStandby) {
  DramChannelStats counts;
  counts.num_activates = counts.num_read_bursts = counts.num_write_bursts = counts.num_refreshes =
      1;
  const auto items = dram_energy(ddr4(), counts, 0);
  EXPECT_NEAR(item(items, "activate_precharge"), 9.6 * (56 * 48 - 39 * 43 - 17 * 34) / 1.2, 1e-6);
  EXPECT_NEAR(item(items, "read"), 9.6 * (135 - 43) * 4 / 1.2, 1e-6);
  EXPECT_NEAR(item(items, "write"), 9.6 * (123 - 43) * 4 / 1.2, 1e-6);
  EXPECT_NEAR(item(items, "refresh"), 9.6 * (250 - 43) * 420 / 1.2, 1e-6);
}

TEST(DramEnergy, StandbyDependsOnWhetherARowIsOpen) {
  DramChannelStats counts;
  counts.active_cycles = 1200;
  const auto items = dram_energy(ddr4(), counts, 3000);
  EXPECT_NEAR(item(items, "active_standby"), 9.6 * 43 * 1000, 1e-3);
  EXPECT_NEAR(item(items, "precharge_standby"), 9.6 * 34 * 1500, 1e-3);
}

TEST(DramEnergy, WhatNoSourceGivesIsUnknownAndNotZero) {
  DramSpec spec = ddr4_spec();
  spec.model = DramModel::kHbm2_2000;
  const auto items = dram_energy(resolve_dram(spec), {}, 1000);
  EXPECT_EQ(item(items, "refresh"), -1);
  EXPECT_EQ(item(items, "read"), 0);
}

TEST(DramEnergy, Hbm2ReadsCostThePublishedEnergyABit) {
  DramSpec spec = ddr4_spec();
  spec.model = DramModel::kHbm2_2000;
  DramChannelStats counts;
  counts.num_read_bursts = 1;
  EXPECT_NEAR(item(dram_energy(resolve_dram(spec), counts, 0), "read") / 256, 3.48, 1e-9);
}

double reported(const TraceRun& run, const std::string& path) {
  StatsTree stats;
  report_trace_run(run, stats);
  return std::get<double>(stats.find(path)->value);
}

// 4096 banks: the sums over channels and ranks are 256 times as long as the run.
TEST(DramEnergy, TheLongestRunWrapsNoSumOverRanks) {
  TraceRun run(ddr4([](DramSpec& spec) { spec.channels = 64, spec.ranks = 4; }), 64);
  run.add({.address = 0, .write = false, .arrival = kLastArrival});
  run.finish();
  const double cycles = 256.0 * 0x1p52;  // of all ranks; a row is open in next to none
  EXPECT_NEAR(reported(run, "memory.energy.precharge_standby") / (9.6 * 34 * cycles / 1.2), 1.0,
              1e-9);
  const double queued = static_cast<double>(run.result().channels.queue_occupancy_cycles);
  EXPECT_GT(queued, 0);
  EXPECT_NEAR(reported(run, "memory.mean_queued") / (queued / (64 * 0x1p52)), 1.0, 1e-9);
}

}  // namespace
}  // namespace sheaf::test
