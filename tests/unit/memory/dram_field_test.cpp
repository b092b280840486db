// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The common set-up beside DRAMsim3, Ramulator 2.1 and DRAMSys, as re-created: the figures are not
// their own output but of programs made after their sources, which are not kept here.
// rtl_notes/dram_comparison.md says how they were found and what of them can be had again.

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <vector>

#include "config/read_config.h"
#include "memory/dram/stream.h"
#include "memory/dram/trace_run.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

constexpr std::uint64_t kReads = 200'000;

DramDevice set_up() {
  return resolve_dram(resolve_config(SHEAF_SOURCE_DIR "/rtl_notes/dram_comparison.toml", {}).dram);
}

TraceRun::Result run(const DramDevice& device, const StreamSpec& spec) {
  TraceRun trace_run(device, 64);
  AccessStream stream(spec, device);
  TraceAccess access;
  while (stream.next(access)) trace_run.add(access);
  trace_run.finish();
  return trace_run.result();
}

TEST(ComparisonSetUp, IsThePreset) {
  const StreamSpec spec{.kind = StreamKind::kRandom, .count = 10'000, .write_share = 0.4};
  const TraceRun::Result written_out = run(set_up(), spec);
  const TraceRun::Result preset = run(ddr4(), spec);
  EXPECT_EQ(written_out.end, preset.end);
  EXPECT_EQ(written_out.read_latency.sum(), preset.read_latency.sum());
  EXPECT_EQ(written_out.write_latency.sum(), preset.write_latency.sum());
}

struct Unsaturated {
  StreamKind kind;
  Cycles gap;
  std::array<double, 3> latency;  ///< tCK
  double hit_percent;             ///< the same for all three
};
std::ostream& operator<<(std::ostream& out, const Unsaturated& u) {
  PrintTo(u.kind, &out);
  return out << " gap " << u.gap;
}

class UnsaturatedField : public testing::TestWithParam<Unsaturated> {};

TEST_P(UnsaturatedField, IsWithinTwoPercentInLatencyAndHalfAPointInRowHits) {
  const Unsaturated& field = GetParam();
  const TraceRun::Result result =
      run(set_up(), {.kind = field.kind, .count = kReads, .gap = field.gap});
  const double latency = static_cast<double>(result.read_latency.sum()) / kReads;
  for (const double theirs : field.latency) EXPECT_NEAR(latency, theirs, 0.02 * theirs);
  const double hits = static_cast<double>(result.channels.num_row_hits);
  EXPECT_NEAR(100 * hits / kReads, field.hit_percent, 0.5);
}

INSTANTIATE_TEST_SUITE_P(
    Streams, UnsaturatedField,
    testing::Values(Unsaturated{StreamKind::kSequential, 16, {39.86, 39.57, 39.65}, 99.05},
                    Unsaturated{StreamKind::kSequential, 100, {34.13, 34.15, 34.20}, 98.16},
                    Unsaturated{StreamKind::kInterleaved, 16, {37.58, 37.15, 37.22}, 98.54},
                    Unsaturated{StreamKind::kInterleaved, 100, {34.09, 33.96, 34.01}, 94.98},
                    Unsaturated{StreamKind::kRandom, 16, {83.16, 81.39, 82.78}, 0},
                    Unsaturated{StreamKind::kRandom, 100, {66.42, 64.83, 65.99}, 0}));

struct Saturated {
  StreamKind kind;
  std::uint32_t queue;
  std::vector<double> bus_percent;
};
std::ostream& operator<<(std::ostream& out, const Saturated& s) {
  PrintTo(s.kind, &out);
  return out << " queue " << s.queue;
}

class SaturatedField : public testing::TestWithParam<Saturated> {};

TEST_P(SaturatedField, IsWithinTwoPercentInBandwidth) {
  const Saturated& field = GetParam();
  DramDevice device = set_up();
  device.read_queue = field.queue;
  const TraceRun::Result result = run(device, {.kind = field.kind, .count = kReads});
  const double busy = static_cast<double>(result.channels.bus_busy_cycles);
  const double bus_percent = 100 * busy / static_cast<double>(result.end);
  for (const double theirs : field.bus_percent) EXPECT_NEAR(bus_percent, theirs, 0.02 * theirs);
}

// DRAMsim3 has a queue of 8 for each bank behind the one of 32: a stream of one bank after the
// other has 40 within its reach.
INSTANTIATE_TEST_SUITE_P(
    Streams, SaturatedField,
    testing::Values(Saturated{StreamKind::kSequential, 32, {74.68, 74.46}},
                    Saturated{StreamKind::kSequential, 40, {78.21}},
                    Saturated{StreamKind::kInterleaved, 32, {95.00, 95.10, 95.10}},
                    Saturated{StreamKind::kRandom, 32, {58.14, 57.75, 57.88}}));

}  // namespace
}  // namespace sheaf::test
