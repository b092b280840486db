// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The common set-up for comparisons, DDR4-2400 17-17-17 with queues of 32: against a controller
// that is simulated cycle by cycle, and against closed forms.

#include <gtest/gtest.h>

#include <tuple>

#include "memory/dram/stream.h"
#include "memory/dram/trace_run.h"
#include "unit/memory/cycle_controller.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

constexpr std::uint64_t kReads = 30'000;

struct Figures {
  double latency = 0, bandwidth = 0, hit_rate = 0;
};

Figures run_sheaf(const DramDevice& device, StreamKind kind, Cycles gap) {
  TraceRun run(device, 64);
  AccessStream stream({.kind = kind, .count = kReads, .gap = gap}, device);
  TraceAccess access;
  while (stream.next(access)) run.add(access);
  run.finish();
  const TraceRun::Result& r = run.result();
  return {static_cast<double>(r.read_latency.sum()) / kReads,
          static_cast<double>(kReads) / static_cast<double>(r.end),
          static_cast<double>(r.channels.num_row_hits) / kReads};
}

Figures run_by_cycles(const DramDevice& device, StreamKind kind, Cycles gap) {
  AccessStream stream({.kind = kind, .count = kReads, .gap = gap}, device);
  std::vector<DramLocation> places;
  TraceAccess access;
  while (stream.next(access)) places.push_back(device.map.locate(access.address));
  const CycleController::Result r = CycleController(device).run(places, gap);
  return {static_cast<double>(r.sum_latency) / kReads,
          static_cast<double>(kReads) / static_cast<double>(r.end),
          static_cast<double>(r.num_row_hits) / kReads};
}

class DramComparison : public testing::TestWithParam<std::tuple<StreamKind, Cycles>> {};

// Where many requests wait, which of several ready commands goes first matters.
class UnsaturatedDram : public DramComparison {};

TEST_P(UnsaturatedDram, EqualsAControllerOfEveryCycle) {
  const auto [kind, gap] = GetParam();
  const DramDevice device = ddr4([](DramSpec& s) { s.refresh = false; });
  const Figures sheaf = run_sheaf(device, kind, gap);
  const Figures reference = run_by_cycles(device, kind, gap);
  EXPECT_DOUBLE_EQ(sheaf.latency, reference.latency);
  EXPECT_DOUBLE_EQ(sheaf.hit_rate, reference.hit_rate);
}

TEST_P(DramComparison, IsCloseToAControllerOfEveryCycleWithRefreshes) {
  const auto [kind, gap] = GetParam();
  const DramDevice device = ddr4();
  const Figures sheaf = run_sheaf(device, kind, gap);
  const Figures reference = run_by_cycles(device, kind, gap);
  // Equal but for which of several ready commands goes first, and so for what a refresh falls on:
  // no bound follows, these tell when the difference grows. With arrivals as fast as they are taken
  // the wait is in front of the queue, which adds it up.
  EXPECT_NEAR(sheaf.latency, reference.latency, (gap == 0 ? 0.1 : 0.01) * reference.latency);
  EXPECT_NEAR(sheaf.bandwidth, reference.bandwidth, 0.01 * reference.bandwidth);
  EXPECT_NEAR(sheaf.hit_rate, reference.hit_rate, 0.001);
}

const auto kStreams =
    testing::Values(StreamKind::kSequential, StreamKind::kRandom, StreamKind::kInterleaved);
INSTANTIATE_TEST_SUITE_P(Streams, DramComparison,
                         testing::Combine(kStreams, testing::Values(0, 8, 16, 100)));
INSTANTIATE_TEST_SUITE_P(Streams, UnsaturatedDram,
                         testing::Combine(kStreams, testing::Values(16, 100)));

// Far apart, a random access finds another row open in its bank: nothing but the sum of the
// latencies of its three commands.
TEST(DramClosedForm, SeldomRandomAccessIsAConflictOfAnIdleBank) {
  const DramDevice device = ddr4([](DramSpec& s) { s.refresh = false; });
  const DramTiming& t = device.timing;
  const double conflict = 1.0 + t.tRP + t.tRCD + t.tCL + t.tBL;
  EXPECT_NEAR(run_sheaf(device, StreamKind::kRandom, 500).latency, conflict, 0.02);
}

TEST(DramClosedForm, SeldomSequentialAccessIsAHitOfAnIdleBank) {
  const DramDevice device = ddr4([](DramSpec& s) { s.refresh = false; });
  const DramTiming& t = device.timing;
  const double hit = 1.0 + t.tCL + t.tBL;
  const double miss = hit + t.tRCD;  // once a row of 128 bursts; later rows of a bank conflict
  const Figures run = run_sheaf(device, StreamKind::kSequential, 500);
  EXPECT_GE(run.latency, hit + (miss - hit) / 128);
  EXPECT_LE(run.latency, hit + (miss - hit + t.tRP) / 128);
}

// A stream that interleaves bank groups keeps the bus busy but for refreshes, which close all rows
// at once and take tRP + tRFC before the first row opens again and tRCD before its first read.
TEST(DramClosedForm, RefreshesTakeTheirShareOfASaturatedBus) {
  const DramDevice device = ddr4();
  const DramTiming& t = device.timing;
  const double lost = static_cast<double>(t.tRP + t.tRFC + t.tRCD) / t.tREFI;
  const double peak = 1.0 / t.tBL;
  const double bandwidth = run_sheaf(device, StreamKind::kInterleaved, 0).bandwidth;
  EXPECT_LE(bandwidth, peak * (1 - lost) * 1.005);
  EXPECT_GE(bandwidth, peak * (1 - lost) * 0.99);
}

// Reads of one bank group follow each other tCCD_L apart.
TEST(DramClosedForm, OneBankGroupReachesTheShareOfTccdL) {
  const DramDevice device = ddr4([](DramSpec& s) { s.refresh = false; });
  ChannelBench bench(device);
  constexpr std::uint32_t kBursts = 120;
  for (std::uint32_t i = 0; i < kBursts; ++i) bench.read(0, {.column = i});
  bench.run();
  const DramTiming& t = device.timing;
  EXPECT_EQ(bench.done_at(kBursts - 1), 1U + t.tRCD + (kBursts - 1) * t.tCCD_L + t.tCL + t.tBL);
}

}  // namespace
}  // namespace sheaf::test
