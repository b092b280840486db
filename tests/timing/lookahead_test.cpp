// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/lookahead.h"

#include <gtest/gtest.h>

#include "timing/bench.h"

namespace sheaf::test {
namespace {

// 0 → 1 → 2 → 3 and 1 → 3; 3 → 0.
LinkMap ring_with_shortcut() {
  LinkMap links;
  links.add(0, 1, 4);
  links.add(1, 2, 2);
  links.add(2, 3, 1);
  links.add(1, 3, 8);
  links.add(3, 0, 5);
  return links;
}

TEST(LinkMap, ReachIsTheLengthOfTheShortestWay) {
  EXPECT_EQ(ring_with_shortcut().reach({1, 2}, 3, 4), (Reach{7, 3, 1, 12}));
}

TEST(LinkMap, CountsOnlyWaysThatEndWithALinkFromTheGivenAgents) {
  EXPECT_EQ(ring_with_shortcut().reach({1}, 3, 4), (Reach{12, 8, 18, 17}));
}

TEST(LinkMap, TakesAnAgentWithoutKnownLinksToBeACycleAwayFromEveryOther) {
  EXPECT_EQ(ring_with_shortcut().reach({2}, 3, 5)[4], 1U);
}

TEST(LinkMap, SaysWhenNothingLeadsThere) {
  LinkMap links;
  links.add(0, 1, 3);
  links.add(1, 0, 3);
  links.add(2, 0, 3);
  EXPECT_EQ(links.reach({}, 2, 3),
            (Reach{LinkMap::kFarAway, LinkMap::kFarAway, LinkMap::kFarAway}));
}

struct Neighbours : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor near{domain};
  Actor far{domain};
  Actor here{domain};
  Lookahead ahead;
  void SetUp() override {
    domain.declare_link(0, 2, 4);
    domain.declare_link(1, 0, 10);
    domain.declare_link(2, 1, 1);
    ahead.bind(domain, {0}, 2);
  }
};

TEST_F(Neighbours, LookaheadIsTheLeastOfTimeAndDistance) {
  domain.schedule(0, 100);
  domain.schedule(1, 95);
  EXPECT_EQ(ahead.earliest(), 104U);
  domain.schedule(1, 89);
  EXPECT_EQ(ahead.earliest(), 103U);
}

TEST_F(Neighbours, LookaheadIsBeyondWhatComesBeforeTheEarliest) {
  domain.schedule(0, 100);
  EXPECT_TRUE(ahead.is_beyond(103));
  EXPECT_FALSE(ahead.is_beyond(104));
}

}  // namespace
}  // namespace sheaf::test
