// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Every command of long random runs against the rules of the standard, written down once more as a
// table of pairs: an oracle that shares nothing with the model but the parameters.

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <tuple>

#include "base/random.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

using C = DramCommand;

bool reads(C c) {
  return c == C::kRead || c == C::kReadPrecharge;
}
bool writes(C c) {
  return c == C::kWrite || c == C::kWritePrecharge;
}

/// The least distance of a later command from an earlier one; 0: none.
Cycles least_distance(const IssuedCommand& a, const IssuedCommand& b, const DramTiming& t) {
  const bool same_rank = a.rank == b.rank;
  const bool same_group = same_rank && a.bank_group == b.bank_group;
  const bool same_bank = same_group && a.bank == b.bank;
  Cycles least = 0;
  const auto need = [&](bool applies, std::int64_t distance) {
    if (applies && distance > static_cast<std::int64_t>(least)) least = distance;
  };
  const bool column_b = reads(b.command) || writes(b.command);
  const bool precharges_b = b.command == C::kPrecharge && same_bank;
  const bool closes_b = precharges_b || (b.command == C::kPrechargeAll && same_rank);
  const std::int64_t write_end = t.tCWL + t.tBL;
  if (a.command == C::kActivate) {
    need(b.command == C::kActivate && same_bank, t.tRC);
    need(b.command == C::kActivate && same_group, t.tRRD_L);
    need(b.command == C::kActivate && same_rank, t.tRRD_S);
    need(reads(b.command) && same_bank, t.tRCD);
    need(writes(b.command) && same_bank, t.tRCDWR);
    need(closes_b, t.tRAS);
    need(b.command == C::kRefresh && same_rank, t.tRC);
  }
  if (a.command == C::kPrecharge) {
    need(b.command == C::kActivate && same_bank, t.tRP);
    need(b.command == C::kRefresh && same_rank, t.tRP);
  }
  if (a.command == C::kPrechargeAll) {
    need((b.command == C::kActivate || b.command == C::kRefresh) && same_rank, t.tRP);
  }
  if (reads(a.command)) {
    need(reads(b.command), same_group ? t.tCCD_L : same_rank ? t.tCCD_S : t.tBL + t.tRTRS);
    need(writes(b.command) && same_rank, t.tRTW);
    need(column_b && !same_rank && writes(b.command),
         std::int64_t{t.tCL} + t.tBL + t.tRTRS - t.tCWL);
    need(closes_b, t.tRTP);
    need(a.command == C::kReadPrecharge && b.command == C::kActivate && same_bank,
         std::int64_t{t.tRTP} + t.tRP);
  }
  if (writes(a.command)) {
    need(writes(b.command), same_group ? t.tCCD_L : same_rank ? t.tCCD_S : t.tBL + t.tRTRS);
    need(reads(b.command) && same_group, write_end + t.tWTR_L);
    need(reads(b.command) && same_rank, write_end + t.tWTR_S);
    need(reads(b.command) && !same_rank, write_end + t.tRTRS - t.tCL);
    need(closes_b, write_end + t.tWR);
    need(a.command == C::kWritePrecharge && b.command == C::kActivate && same_bank,
         write_end + t.tWR + t.tRP);
  }
  if (a.command == C::kRefresh) {
    need((b.command == C::kActivate || b.command == C::kRefresh) && same_rank, t.tRFC);
  }
  return least;
}

class ProtocolChecker {
 public:
  explicit ProtocolChecker(const DramDevice& device) : device_(device) {}

  void check(const IssuedCommand& b) {
    const DramTiming& t = device_.timing;
    while (!recent_.empty() && recent_.front().at + t.tRFC + t.tRC < b.at) recent_.pop_front();
    std::size_t activations = 0;
    for (const IssuedCommand& a : recent_) {
      ASSERT_GE(b.at - a.at, least_distance(a, b, t))
          << int(a.command) << " at " << a.at << ", " << int(b.command) << " at " << b.at;
      if (a.command == C::kActivate && a.rank == b.rank && a.at + t.tFAW > b.at) ++activations;
    }
    if (b.command == C::kActivate) {
      ASSERT_LT(activations, 4U) << "tFAW at " << b.at;
    }
    if (!device_.separate_row_bus && !recent_.empty()) {
      ASSERT_LT(recent_.back().at, b.at);
    }
    check_state(b);
    recent_.push_back(b);
  }

 private:
  // Commands meet banks in the state that they need.
  void check_state(const IssuedCommand& b) {
    const auto key = std::tuple(b.rank, b.bank_group, b.bank);
    switch (b.command) {
      case C::kActivate:
        ASSERT_FALSE(open_.contains(key));
        open_[key] = b.row;
        break;
      case C::kPrecharge:
        ASSERT_TRUE(open_.contains(key));
        open_.erase(key);
        break;
      case C::kPrechargeAll:
        std::erase_if(open_, [&](const auto& bank) { return std::get<0>(bank.first) == b.rank; });
        break;
      case C::kRefresh:
        for (const auto& [bank, row] : open_) ASSERT_NE(std::get<0>(bank), b.rank);
        break;
      default:
        ASSERT_TRUE(open_.contains(key));
        ASSERT_EQ(open_[key], b.row);
        if (b.command == C::kReadPrecharge || b.command == C::kWritePrecharge) open_.erase(key);
    }
  }

  const DramDevice device_;
  std::deque<IssuedCommand> recent_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> open_;
};

struct Load {
  std::uint64_t gap = 0;  ///< mean, tCK
  std::uint64_t rows = 0;
  double writes = 0;
};
void PrintTo(const Load& load, std::ostream* out) {
  *out << load.gap << " tCK, " << load.rows << " rows, " << load.writes << " written";
}

void run_load(const DramDevice& device, const Load& load, std::uint64_t seed) {
  DramChannel channel(device);
  ProtocolChecker checker(device);
  channel.watch([&](const IssuedCommand& command) {
    if (!testing::Test::HasFatalFailure()) checker.check(command);
  });
  Random random(seed);
  std::vector<DramDone> done;
  Cycles now = 0;
  constexpr std::uint32_t kRequests = 20000;
  for (std::uint32_t i = 0; i < kRequests; ++i) {
    now += random.below(2 * load.gap + 1);
    channel.push(
        {.arrival = now,
         .tag = i,
         .bank = static_cast<std::uint32_t>(random.below(device.organization.banks_per_channel())),
         .row = static_cast<std::uint32_t>(random.below(load.rows)),
         .column = static_cast<std::uint32_t>(random.below(device.organization.columns)),
         .bursts = 1,
         .write = random.uniform() < load.writes});
  }
  channel.advance(kNever, done);
  EXPECT_EQ(done.size(), kRequests);
  const DramChannelStats stats = channel.stats(channel.now());
  EXPECT_EQ(stats.num_row_hits + stats.num_row_misses + stats.num_row_conflicts,
            stats.num_reads + stats.num_writes);
  EXPECT_EQ(stats.num_reads + stats.num_writes + stats.num_forwarded + stats.num_merged, kRequests);
  EXPECT_EQ(stats.sum_queue_residence, stats.queue_occupancy_cycles) << "Little's law";
}

class DramProtocol : public testing::TestWithParam<std::tuple<DramModel, Load, PagePolicy>> {};

TEST_P(DramProtocol, NoCommandBreaksARule) {
  const auto& [model, load, page] = GetParam();
  for (const std::uint32_t ranks : {1U, 2U}) {
    DramSpec spec = ddr4_spec();
    spec.model = model;
    spec.page = page;
    spec.ranks = ranks;
    run_load(resolve_dram(spec), load, ranks);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Loads, DramProtocol,
    testing::Combine(testing::Values(DramModel::kDdr4_2400, DramModel::kDdr4_3200,
                                     DramModel::kLpddr5_6400, DramModel::kGddr6_14000,
                                     DramModel::kHbm2_2000),
                     testing::Values(Load{0, 2, 0.3}, Load{3, 4, 0.5}, Load{10, 1000, 0},
                                     Load{50, 3, 0.3}, Load{400, 2, 0.5}, Load{5, 1000, 1}),
                     testing::Values(PagePolicy::kOpen, PagePolicy::kClosed)));

}  // namespace
}  // namespace sheaf::test
