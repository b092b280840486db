// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/event_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "base/random.h"
#include "kdtree/split_event.h"

namespace sheaf::test {
namespace {

std::vector<float> awkward_floats() {
  constexpr float kMax = std::numeric_limits<float>::max();
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  return {-kMax, -1e6F, -1.0F, -1e-30F, -kTiny, 0.0F, kTiny, 1e-30F, 1.0F, 1.0000001F, 1e6F, kMax};
}

TEST(SplitEvent, KeysHaveTheOrderOfTheirFloats) {
  const std::vector<float> floats = awkward_floats();
  for (std::size_t i = 0; i + 1 < floats.size(); ++i) {
    EXPECT_LT(coordinate_key(floats[i]), coordinate_key(floats[i + 1]));
  }
  for (const float value : floats) EXPECT_EQ(key_coordinate(coordinate_key(value)), value);
}

TEST(SplitEvent, BothZerosAreOneCoordinate) {
  EXPECT_EQ(coordinate_key(0.0F), coordinate_key(-0.0F));
}

TEST(SplitEvent, FieldsSurvivePacking) {
  const SplitEvent event = make_event(-2.5F, EventKind::kStart, kMaxEventTriangle);
  EXPECT_EQ(key_coordinate(event_key(event)), -2.5F);
  EXPECT_EQ(event_kind(event), EventKind::kStart);
  EXPECT_EQ(event_triangle(event), kMaxEventTriangle);
}

TEST(SplitEvent, EndsComeBeforePlanarBeforeStartsAtOneCoordinate) {
  const SplitEvent end = make_event(1.0F, EventKind::kEnd, 9);
  const SplitEvent planar = make_event(1.0F, EventKind::kPlanar, 5);
  const SplitEvent start = make_event(1.0F, EventKind::kStart, 1);
  EXPECT_LT(end, planar);
  EXPECT_LT(planar, start);
  EXPECT_LT(start, make_event(1.0000001F, EventKind::kEnd, 0));
}

TEST(EventSort, EqualsComparisonSort) {
  Random random(3);
  const std::vector<float> floats = awkward_floats();
  std::vector<SplitEvent> events;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const float value =
        i % 3 == 0 ? floats[random.below(floats.size())] : (random.uniform() - 0.5F) * 1000.0F;
    events.push_back(make_event(value, static_cast<EventKind>(random.below(3)), i));
  }
  std::vector<SplitEvent> expected = events;
  std::sort(expected.begin(), expected.end());
  std::vector<SplitEvent> scratch(events.size());
  sort_events(events, scratch);
  EXPECT_EQ(events, expected);
}

TEST(EventSort, NoEventsAreSorted) {
  std::vector<SplitEvent> events;
  sort_events(events, events);
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace sheaf::test
