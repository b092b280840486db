// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The whole against closed forms of queueing.

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "memory/dram/stream.h"
#include "memory/dram/trace_run.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

double uniform(Random& random) {
  return (static_cast<double>(random.next() >> 11) + 0.5) * 0x1p-53;
}

// Poisson arrivals at one bank, each for another row: the bank serves one after the other, each for
// tRC. Pollaczek and Khinchine: mean wait = rho S / (2 (1 - rho)).
TEST(DramQueueing, PoissonArrivalsAtOneBankWaitAsInMD1) {
  for (const double rho : {0.3, 0.6, 0.8}) {
    const DramDevice device = ddr4([](DramSpec& s) {
      s.refresh = false;
      s.read_queue = 1024;
    });
    DramChannel channel(device);
    Random random(11);
    const double service = device.timing.tRC;
    constexpr std::uint32_t kRequests = 400'000;
    double time = 0;
    std::vector<DramDone> done;
    for (std::uint32_t i = 0; i < kRequests; ++i) {
      time += -std::log(uniform(random)) * service / rho;
      channel.push({.arrival = static_cast<Cycles>(time), .tag = i, .bank = 0, .row = i});
    }
    channel.advance(kNever, done);
    double sum = 0;
    for (const DramDone& one : done) sum += static_cast<double>(one.at - one.accepted);
    const DramTiming& t = device.timing;
    const double unloaded = 1.0 + t.tRP + t.tRCD + t.tCL + t.tBL;
    const double wait = sum / kRequests - unloaded;
    const double expected = rho * service / (2 * (1 - rho));
    EXPECT_NEAR(wait, expected, 0.03 * expected) << rho;
  }
}

TEST(DramQueueing, SaturatedBusComesCloseToItsPeakAndNeverExceedsIt) {
  for (const DramModel model :
       {DramModel::kDdr4_2400, DramModel::kDdr4_3200, DramModel::kLpddr5_6400,
        DramModel::kGddr6_14000, DramModel::kHbm2_2000}) {
    double before = 0;
    for (const Cycles gap : {16, 8, 2, 0}) {
      DramSpec spec = ddr4_spec();
      spec.model = model;
      const DramDevice device = resolve_dram(spec);
      TraceRun run(device, 64);
      AccessStream stream({.kind = StreamKind::kInterleaved, .count = 100'000, .gap = gap}, device);
      TraceAccess access;
      while (stream.next(access)) run.add(access);
      run.finish();
      const double share = run.result().bandwidth(device.clock_hz) / device.peak_bandwidth();
      EXPECT_LE(share, 1.0) << device.name << " gap " << gap;
      EXPECT_GE(share, before * 0.999) << device.name << " gap " << gap;
      before = share;
    }
    const DramTiming t = resolve_dram([&] {
                           DramSpec spec = ddr4_spec();
                           spec.model = model;
                           return spec;
                         }())
                             .timing;
    const double refreshing = static_cast<double>(t.tRFC + t.tRP) / t.tREFI;
    EXPECT_GE(before, 0.97 * (1 - refreshing)) << to_string(model);
  }
}

TEST(DramQueueing, LittlesLawHoldsExactly) {
  for (const Cycles gap : {0, 8, 16, 100}) {
    const DramDevice device = ddr4();
    TraceRun run(device, 64);
    AccessStream stream(
        {.kind = StreamKind::kRandom, .count = 20'000, .gap = gap, .write_share = 0.3}, device);
    TraceAccess access;
    while (stream.next(access)) run.add(access);
    run.finish();
    const DramChannelStats& stats = run.result().channels;
    EXPECT_EQ(stats.queue_occupancy_cycles, stats.sum_queue_residence);
  }
}

// tFAW binds activations, and each random access needs one: four bursts a window.
TEST(DramQueueing, RandomAccessesAreBoundByTheActivationWindow) {
  const DramDevice device = ddr4([](DramSpec& s) { s.refresh = false; });
  TraceRun run(device, 64);
  AccessStream stream({.kind = StreamKind::kRandom, .count = 100'000}, device);
  TraceAccess access;
  while (stream.next(access)) run.add(access);
  run.finish();
  const double share = run.result().bandwidth(device.clock_hz) / device.peak_bandwidth();
  const double bound = 4.0 * device.timing.tBL / device.timing.tFAW;
  EXPECT_LE(share, bound);
  EXPECT_GE(share, 0.97 * bound);
}

// It gets the other's place in the queue in the very cycle in which the other's read is issued, and
// is ready in that cycle, too.
TEST(DramQueueing, ARequestThatTakesTheOnlyPlaceAtOnceIsServed) {
  ChannelBench bench(ddr4([](DramSpec& s) {
    s.read_queue = 1;
    s.controller_latency = 0;
    s.refresh = false;
  }));
  bench.read(0, {.row = 1, .column = 0}).read(0, {.row = 1, .column = 8}).run();
  EXPECT_EQ(bench.at(DramCommand::kRead, 1), bench.at(DramCommand::kRead, 0) + 6);  // tCCD_L
  EXPECT_NE(bench.done_at(1), kNever);
}

}  // namespace
}  // namespace sheaf::test
