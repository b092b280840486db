// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/counters.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "stats/counter_group.h"

namespace sheaf {
namespace {

#define DOOR_STATS(X)                                        \
  X(num_openings, "times", "Times that the door was opened") \
  X(num_knocks, "knocks", "Knocks heard")
SHEAF_STATS(DoorStats, DOOR_STATS);

TEST(Counters, AreZeroAtFirst) {
  EXPECT_EQ(DoorStats{}.num_openings + DoorStats{}.num_knocks, 0U);
}

TEST(Counters, AreEnumeratedInOrderWithTheirDeclaration) {
  const DoorStats stats{.num_openings = 3, .num_knocks = 5};
  std::vector<std::string> seen;
  stats.for_each([&](const CounterInfo& info, std::uint64_t value) {
    seen.push_back(std::string(info.name) + ' ' + std::string(info.unit) + ' ' +
                   std::to_string(value));
  });
  EXPECT_EQ(seen, (std::vector<std::string>{"num_openings times 3", "num_knocks knocks 5"}));
  ASSERT_EQ(DoorStats::infos().size(), 2U);
  EXPECT_EQ(DoorStats::infos()[1].meaning, "Knocks heard");
}

TEST(Counters, AddMemberByMember) {
  DoorStats sum{.num_openings = 1, .num_knocks = 2};
  sum += DoorStats{.num_openings = 10, .num_knocks = 20};
  EXPECT_EQ(sum, (DoorStats{.num_openings = 11, .num_knocks = 22}));
}

TEST(Counters, ArePrintedInAlignedColumns) {
  const std::vector<CounterGroup> groups{{"house.door", "The front door", DoorStats::infos()}};
  EXPECT_EQ(print_counters(groups),
            "house.door\n"
            "  The front door\n"
            "  .num_openings  times   Times that the door was opened\n"
            "  .num_knocks    knocks  Knocks heard\n");
}

}  // namespace
}  // namespace sheaf
