// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// One test a timing parameter, in the manner of ChampSim's 401-hit-latency: with all others out of
// the way, the second command is not issued a cycle before the parameter allows it, and is issued
// when it does. Each value is tried and then one cycle more, so that no other rule can be what
// decides.

#include <gtest/gtest.h>

#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

using C = DramCommand;

// Small values for all parameters but the one under test, which is larger than any sum of them.
constexpr std::uint32_t kLarge = 200;

DramSpec quick_spec() {
  DramSpec spec = ddr4_spec();
  spec.refresh = false;
  DramTiming& t = spec.timing;
  t = {.tCL = 3,
       .tCWL = 3,
       .tBL = 1,
       .tRCD = 2,
       .tRCDWR = 2,
       .tRP = 2,
       .tRAS = 4,
       .tRC = 6,
       .tCCD_S = 1,
       .tCCD_L = 1,
       .tRRD_S = 1,
       .tRRD_L = 1,
       .tFAW = 4,
       .tWR = 1,
       .tWTR_S = 1,
       .tWTR_L = 1,
       .tRTP = 1,
       .tRTW = 1,
       .tRTRS = 1,
       .tRFC = 10,
       .tREFI = 5000};
  return spec;
}

using Field = std::uint32_t DramTiming::*;
using Drive = std::function<void(ChannelBench&)>;
using Gap = std::function<Cycles(const ChannelBench&)>;

/// Runs `drive` with the parameter at kLarge and at kLarge + 1; the gap must follow exactly.
void expect_gap(Field field, const Drive& drive, const Gap& gap, Cycles beside = 0,
                const Change& change = {}) {
  for (const std::uint32_t value : {kLarge, kLarge + 1}) {
    DramSpec spec = quick_spec();
    if (change) change(spec);
    spec.timing.*field = value;
    ChannelBench bench(resolve_dram(spec));
    drive(bench);
    bench.run();
    EXPECT_EQ(gap(bench), value + beside);
  }
}

Gap between(C first, C second, std::size_t n = 0) {
  return [=](const ChannelBench& bench) {
    return bench.at(second, first == second ? n + 1 : n) - bench.at(first, n);
  };
}

TEST(DramTiming, ReadWaitsForTrcdAfterActivate) {
  expect_gap(
      &DramTiming::tRCD, [](ChannelBench& b) { b.read(0, {}); }, between(C::kActivate, C::kRead), 0,
      [](DramSpec& s) { s.timing.tRAS = s.timing.tRC = 2 * kLarge; });
}

TEST(DramTiming, WriteWaitsForTrcdwrAfterActivate) {
  expect_gap(
      &DramTiming::tRCDWR, [](ChannelBench& b) { b.write(0, {}); },
      between(C::kActivate, C::kWrite));
}

TEST(DramTiming, ActivateWaitsForTrpAfterPrecharge) {
  expect_gap(
      &DramTiming::tRP, [](ChannelBench& b) { b.read(0, {.row = 1}).read(500, {.row = 2}); },
      [](const ChannelBench& b) { return b.at(C::kActivate, 1) - b.at(C::kPrecharge); });
}

TEST(DramTiming, PrechargeWaitsForTrasAfterActivate) {
  expect_gap(
      &DramTiming::tRAS, [](ChannelBench& b) { b.read(0, {.row = 1}).read(1, {.row = 2}); },
      between(C::kActivate, C::kPrecharge), 0, [](DramSpec& s) { s.timing.tRC = 2 * kLarge; });
}

TEST(DramTiming, ActivateWaitsForTrcAfterActivateOfItsBank) {
  expect_gap(
      &DramTiming::tRC, [](ChannelBench& b) { b.read(0, {.row = 1}).read(1, {.row = 2}); },
      between(C::kActivate, C::kActivate));
}

TEST(DramTiming, DataOfAReadEndTclPlusTblAfterIt) {
  expect_gap(
      &DramTiming::tCL, [](ChannelBench& b) { b.read(0, {}); },
      [](const ChannelBench& b) { return b.done_at(0) - b.at(C::kRead); }, 1);
}

TEST(DramTiming, DataOfAWriteEndTcwlPlusTblAfterIt) {
  expect_gap(
      &DramTiming::tCWL, [](ChannelBench& b) { b.write(0, {}); },
      [](const ChannelBench& b) { return b.done_at(0) - b.at(C::kWrite); }, 1);
}

TEST(DramTiming, BurstTakesTbl) {
  expect_gap(
      &DramTiming::tBL, [](ChannelBench& b) { b.read(0, {}); },
      [](const ChannelBench& b) { return b.done_at(0) - b.at(C::kRead); }, 3,
      [](DramSpec& s) { s.timing.tCCD_S = s.timing.tCCD_L = 2 * kLarge; });
}

TEST(DramTiming, ReadsOfOneBankGroupKeepTccdLApart) {
  expect_gap(
      &DramTiming::tCCD_L, [](ChannelBench& b) { b.read(0, {.column = 0}).read(0, {.column = 1}); },
      between(C::kRead, C::kRead));
}

TEST(DramTiming, WritesOfOneBankGroupKeepTccdLApart) {
  expect_gap(
      &DramTiming::tCCD_L, [](ChannelBench& b) { b.write(0, {.bank = 0}).write(0, {.bank = 1}); },
      between(C::kWrite, C::kWrite));
}

TEST(DramTiming, ReadsOfTwoBankGroupsKeepTccdSApart) {
  expect_gap(
      &DramTiming::tCCD_S, [](ChannelBench& b) { b.read(0, {.group = 0}).read(0, {.group = 1}); },
      between(C::kRead, C::kRead), 0, [](DramSpec& s) { s.timing.tCCD_L = 4 * kLarge; });
}

TEST(DramTiming, WritesOfTwoBankGroupsKeepTccdSApart) {
  expect_gap(
      &DramTiming::tCCD_S, [](ChannelBench& b) { b.write(0, {.group = 0}).write(0, {.group = 1}); },
      between(C::kWrite, C::kWrite), 0, [](DramSpec& s) { s.timing.tCCD_L = 4 * kLarge; });
}

TEST(DramTiming, ActivatesOfOneBankGroupKeepTrrdLApart) {
  expect_gap(
      &DramTiming::tRRD_L, [](ChannelBench& b) { b.read(0, {.bank = 0}).read(0, {.bank = 1}); },
      between(C::kActivate, C::kActivate));
}

TEST(DramTiming, ActivatesOfTwoBankGroupsKeepTrrdSApart) {
  expect_gap(
      &DramTiming::tRRD_S, [](ChannelBench& b) { b.read(0, {.group = 0}).read(0, {.group = 1}); },
      between(C::kActivate, C::kActivate), 0,
      [](DramSpec& s) { s.timing.tRRD_L = s.timing.tFAW = 4 * kLarge; });
}

TEST(DramTiming, FifthActivateWaitsForTfawAfterTheFirst) {
  expect_gap(
      &DramTiming::tFAW,
      [](ChannelBench& b) {
        for (std::uint32_t i = 0; i < 5; ++i) b.read(0, {.group = i % 4, .bank = i / 4});
      },
      [](const ChannelBench& b) { return b.at(C::kActivate, 4) - b.at(C::kActivate, 0); });
}

TEST(DramTiming, FourthActivateDoesNotWaitForTfaw) {
  DramSpec spec = quick_spec();
  spec.timing.tFAW = kLarge;
  ChannelBench bench(resolve_dram(spec));
  for (std::uint32_t i = 0; i < 4; ++i) bench.read(0, {.group = i});
  bench.run();
  EXPECT_LT(bench.at(C::kActivate, 3), kLarge);
}

TEST(DramTiming, PrechargeWaitsForTrtpAfterARead) {
  expect_gap(
      &DramTiming::tRTP, [](ChannelBench& b) { b.read(0, {.row = 1}).read(1, {.row = 2}); },
      between(C::kRead, C::kPrecharge));
}

TEST(DramTiming, PrechargeWaitsForTwrAfterWrittenData) {
  expect_gap(
      &DramTiming::tWR, [](ChannelBench& b) { b.write(0, {.row = 1}).write(1, {.row = 2}); },
      between(C::kWrite, C::kPrecharge), 3 + 1);
}

TEST(DramTiming, ReadOfTheBankGroupWaitsForTwtrLAfterWrittenData) {
  expect_gap(
      &DramTiming::tWTR_L, [](ChannelBench& b) { b.write(0, {}).read(5, {.column = 9}); },
      between(C::kWrite, C::kRead), 3 + 1);
}

TEST(DramTiming, ReadOfAnotherBankGroupWaitsForTwtrSAfterWrittenData) {
  expect_gap(
      &DramTiming::tWTR_S, [](ChannelBench& b) { b.write(0, {.group = 0}).read(5, {.group = 1}); },
      between(C::kWrite, C::kRead), 3 + 1, [](DramSpec& s) { s.timing.tWTR_L = 4 * kLarge; });
}

TEST(DramTiming, WriteWaitsForTrtwAfterARead) {
  expect_gap(
      &DramTiming::tRTW, [](ChannelBench& b) { b.read(0, {.group = 0}).write(1, {.group = 1}); },
      between(C::kRead, C::kWrite));
}

TEST(DramTiming, ReadsOfTwoRanksLeaveTrtrsBetweenTheirData) {
  expect_gap(
      &DramTiming::tRTRS, [](ChannelBench& b) { b.read(0, {.rank = 0}).read(0, {.rank = 1}); },
      between(C::kRead, C::kRead), 1, [](DramSpec& s) { s.ranks = 2; });
}

TEST(DramTiming, WritesOfTwoRanksLeaveTrtrsBetweenTheirData) {
  expect_gap(
      &DramTiming::tRTRS, [](ChannelBench& b) { b.write(0, {.rank = 0}).write(0, {.rank = 1}); },
      between(C::kWrite, C::kWrite), 1, [](DramSpec& s) { s.ranks = 2; });
}

// The data of a read begin tCL after it, those of a write tCWL: both are 3 here.
TEST(DramTiming, WriteOfAnotherRankLeavesTrtrsAfterTheDataOfARead) {
  expect_gap(
      &DramTiming::tRTRS, [](ChannelBench& b) { b.read(0, {.rank = 0}).write(1, {.rank = 1}); },
      between(C::kRead, C::kWrite), 1, [](DramSpec& s) { s.ranks = 2; });
}

TEST(DramTiming, ReadOfAnotherRankLeavesTrtrsAfterTheDataOfAWrite) {
  expect_gap(
      &DramTiming::tRTRS, [](ChannelBench& b) { b.write(0, {.rank = 0}).read(5, {.rank = 1}); },
      between(C::kWrite, C::kRead), 1, [](DramSpec& s) { s.ranks = 2; });
}

TEST(DramTiming, ActivateWaitsForTrfcAfterARefresh) {
  expect_gap(
      &DramTiming::tRFC, [](ChannelBench& b) { b.read(5001, {}); },
      between(C::kRefresh, C::kActivate), 0, [](DramSpec& s) { s.refresh = true; });
}

TEST(DramTiming, RefreshesComeEveryTrefi) {
  expect_gap(
      &DramTiming::tREFI, [](ChannelBench& b) { b.read(5 * kLarge, {}); },
      between(C::kRefresh, C::kRefresh), 0, [](DramSpec& s) { s.refresh = true; });
}

// Refreshes of idle time are done at once unless someone watches; both must come to the same.
TEST(DramTiming, IdleRefreshesDoneAtOnceComeToTheSame) {
  for (const std::uint32_t ranks : {1U, 2U, 4U}) {
    const DramDevice device = ddr4([&](DramSpec& s) { s.ranks = ranks; });
    const Cycles period = device.timing.tREFI;
    for (const Cycles gap : {period, 3 * period - 1, 10 * period + 1, 1000 * period + 17}) {
      DramChannel watched(device);
      watched.watch([](const IssuedCommand&) {});
      DramChannel alone(device);
      std::vector<DramDone> seen;
      std::vector<DramDone> done;
      for (std::uint32_t i = 0; i < 5; ++i) {
        const DramRequest request{.arrival = i * gap,
                                  .tag = i,
                                  .bank = i % 2,
                                  .row = 7 * i,
                                  .bursts = 1,
                                  .write = i == 3};
        watched.push(request);
        alone.push(request);
      }
      watched.advance(5 * gap, seen);
      alone.advance(5 * gap, done);
      ASSERT_EQ(done.size(), 5U);
      for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i].at, seen[i].at) << gap;
      EXPECT_EQ(alone.now(), watched.now()) << gap;
      std::vector<std::uint64_t> counts[2];
      watched.stats(5 * gap).for_each([&](auto&&, std::uint64_t n) { counts[0].push_back(n); });
      alone.stats(5 * gap).for_each([&](auto&&, std::uint64_t n) { counts[1].push_back(n); });
      EXPECT_EQ(counts[0], counts[1]) << gap;
    }
  }
}

TEST(DramTiming, OpenRowIsClosedTrpBeforeARefresh) {
  DramSpec spec = quick_spec();
  spec.refresh = true;
  ChannelBench bench(resolve_dram(spec));
  bench.read(4000, {}).read(5001, {});
  bench.run();
  EXPECT_EQ(bench.at(C::kPrechargeAll), 5000U);
  EXPECT_EQ(bench.at(C::kRefresh), 5002U);
}

TEST(DramTiming, RequestGetsItsFirstCommandControllerLatencyAfterItsArrival) {
  for (const std::uint32_t latency : {0U, 1U, 7U}) {
    DramSpec spec = quick_spec();
    spec.controller_latency = latency;
    ChannelBench bench(resolve_dram(spec));
    bench.read(100, {}).run();
    EXPECT_EQ(bench.at(C::kActivate), 100U + latency);
  }
}

// JESD79-4: an idle bank answers after tRCD + CL + BL/2, an open row after CL + BL/2, a bank with
// another row after tRP + tRCD + CL + BL/2; one cycle of the controller comes on top.
TEST(DramTiming, UnloadedLatenciesAreTheClosedForms) {
  ChannelBench bench(ddr4());
  bench.read(0, {.row = 1}).read(200, {.row = 1, .column = 3}).read(400, {.row = 2}).run();
  EXPECT_EQ(bench.done_at(0), 0U + 1 + 17 + 17 + 4);
  EXPECT_EQ(bench.done_at(1), 200U + 1 + 17 + 4);
  EXPECT_EQ(bench.done_at(2), 400U + 1 + 17 + 17 + 17 + 4);
}

TEST(DramTiming, OneCommandACycle) {
  DramSpec spec = quick_spec();
  ChannelBench bench(resolve_dram(spec));
  for (std::uint32_t i = 0; i < 16; ++i) bench.read(0, {.group = i % 4, .bank = i / 4});
  bench.run();
  for (std::size_t i = 1; i < bench.commands().size(); ++i) {
    EXPECT_LT(bench.commands()[i - 1].at, bench.commands()[i].at);
  }
}

TEST(DramTiming, WithABusForRowCommandsBothKindsShareACycle) {
  DramDevice device = resolve_dram(quick_spec());
  device.separate_row_bus = true;
  ChannelBench bench(device);
  // Bank 1 is activated in the very cycle in which bank 0 is read.
  bench.read(0, {.group = 0}).read(2, {.group = 1}).run();
  EXPECT_EQ(bench.at(C::kRead, 0), 3U);
  EXPECT_EQ(bench.at(C::kActivate, 1), 3U);
}

}  // namespace
}  // namespace sheaf::test
