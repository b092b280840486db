// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Against output of DRAMsim3 itself, as published in github.com/Wty2003328/silicon-design-notebook
// (its page on DRAM simulators, section 12): what DDR4-3200 with two ranks, mapping rochrababgco
// and command queues of 8 a bank serves in 200,000 cycles of a saturating stream of reads.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "memory/dram/trace_run.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

constexpr double kCycles = 200'000;
constexpr double kCycleNs = 0.63;

// Reads of 64 bytes in kCycles that make so many GB/s.
std::uint64_t reads_at(double gigabytes_per_second) {
  return static_cast<std::uint64_t>(std::lround(gigabytes_per_second * kCycles * kCycleNs / 64));
}

struct Published {
  const char* name;
  Bytes stride;
  std::uint32_t transaction_queue;
  std::uint64_t reads;
  /// Of a command queue, which a stream of one bank after the other has in its reach as well; no
  /// matter where the queues hold one bank's requests alone.
  std::uint32_t command_queue;
};
std::ostream& operator<<(std::ostream& out, const Published& p) {
  return out << p.name;
}

class PublishedDramsim3 : public testing::TestWithParam<Published> {};

TEST_P(PublishedDramsim3, ServesAsManyReadsInAsManyCycles) {
  const Published& published = GetParam();
  const DramDevice device = ddr4([&](DramSpec& s) {
    s.model = DramModel::kDdr4_3200;
    s.ranks = 2;
    s.mapping = "row:16 rank:1 bank:2 bankgroup:2 column:7";
    s.timing.tRTRS = 1;
    s.read_queue = published.transaction_queue + published.command_queue;
  });
  TraceRun run(device, 64);
  constexpr Address kBase = 0x10000000;
  for (std::uint64_t i = 0; i < published.reads; ++i) {
    run.add({.address = kBase + i * published.stride});
  }
  run.finish();
  EXPECT_NEAR(static_cast<double>(run.result().end), kCycles, 0.006 * kCycles);
}

INSTANTIATE_TEST_SUITE_P(Streams, PublishedDramsim3,
                         testing::Values(Published{"Sequential8", 64, 8, reads_at(13.41), 8},
                                         Published{"Sequential16", 64, 16, reads_at(14.42), 8},
                                         Published{"Sequential32", 64, 32, 33'191, 8},
                                         Published{"Sequential64", 64, 64, reads_at(23.85), 8},
                                         Published{"OneBank", Bytes{256} << 10, 32, 2'576, 0},
                                         Published{"ABankOfEachRank", Bytes{128} << 10, 32, 5'157,
                                                   0}),
                         [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace sheaf::test
