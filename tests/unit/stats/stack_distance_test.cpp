// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/stack_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <list>
#include <random>

namespace sheaf {
namespace {

using Lines = std::vector<std::uint64_t>;

/// One cache, simulated: a list a set, the line used last in front.
std::uint64_t simulate_misses(const Lines& lines, std::uint32_t num_sets, std::uint64_t ways) {
  std::vector<std::list<std::uint64_t>> sets(num_sets);
  std::uint64_t misses = 0;
  for (const std::uint64_t line : lines) {
    auto& set = sets[line % num_sets];
    const auto found = std::ranges::find(set, line);
    if (found != set.end()) {
      set.erase(found);
    } else {
      ++misses;
    }
    set.push_front(line);
    if (set.size() > ways) set.pop_back();
  }
  return misses;
}

MissCurve curve_of(const Lines& lines, std::uint32_t num_sets) {
  StackDistances distances(num_sets);
  MissCurve curve;
  distances.access_all(lines, [&](std::uint32_t distance) { curve.add(distance); });
  return curve;
}

/// Mostly lines near the last one, at times any of `range`, at times a scan.
Lines mixed_lines(std::size_t count, std::uint64_t range, std::uint32_t seed) {
  std::mt19937 random(seed);
  Lines lines;
  std::uint64_t here = 0;
  while (lines.size() < count) {
    if (random() % 8 == 0) here = random() % range;
    const std::size_t run = random() % 64 == 0 ? 100 : 1;
    for (std::size_t i = 0; i < run; ++i) lines.push_back(here++ % range);
    here = (here + range - random() % 5) % range;
  }
  return lines;
}

TEST(StackDistances, OfASmallStreamAreThoseCountedByHand) {
  StackDistances distances;
  const Lines lines{7, 8, 7, 7, 9, 8, 7};
  const std::vector<std::uint32_t> expected{
      StackDistances::kFirstUse, StackDistances::kFirstUse, 1, 0, StackDistances::kFirstUse, 2, 2};
  std::vector<std::uint32_t> found;
  for (const std::uint64_t line : lines) found.push_back(distances.access(line));
  EXPECT_EQ(found, expected);
  EXPECT_EQ(distances.num_lines(), 3);
}

TEST(StackDistances, OfACycleAreOneLessThanItsLength) {
  // Long enough for several renumberings, and for blocks of stamps.
  constexpr std::uint64_t kLength = 3000;
  StackDistances distances;
  for (std::uint64_t i = 0; i < 20 * kLength; ++i) {
    const std::uint32_t distance = distances.access(i % kLength * 1'000'003);
    ASSERT_EQ(distance, i < kLength ? StackDistances::kFirstUse : kLength - 1) << i;
  }
}

TEST(StackDistances, OfSetsDoNotMix) {
  StackDistances distances(2);
  for (const std::uint64_t line : Lines{0, 1, 3, 5}) distances.access(line);
  EXPECT_EQ(distances.access(0), 0) << "lines 1, 3 and 5 are in the other set";
  EXPECT_EQ(distances.access(1), 2);
}

TEST(StackDistances, TakeSetsInPowersOfTwoOnly) {
  EXPECT_THROW(StackDistances(3), std::logic_error);
  EXPECT_THROW(StackDistances(0), std::logic_error);
}

TEST(StackDistances, AreTheSameOneByOneAndManyAtOnce) {
  const Lines lines = mixed_lines(20'000, 3'000, 5);
  StackDistances one_by_one(4);
  StackDistances many(4);
  std::size_t i = 0;
  many.access_all(
      lines, [&](std::uint32_t distance) { EXPECT_EQ(distance, one_by_one.access(lines[i++])); });
  EXPECT_EQ(i, lines.size());
}

class EachNumberOfSets : public testing::TestWithParam<std::uint32_t> {};

TEST_P(EachNumberOfSets, GivesTheMissesOfEverySizeSimulatedOnItsOwn) {
  for (const std::uint64_t range : {10, 400, 5'000}) {
    const Lines lines = mixed_lines(20'000, range, static_cast<std::uint32_t>(range));
    const auto points = curve_of(lines, GetParam()).points();
    for (std::uint64_t ways = 1; ways * GetParam() < 2 * range; ways += ways / 2 + 1) {
      EXPECT_EQ(misses_at(points, ways), simulate_misses(lines, GetParam(), ways))
          << range << " lines, " << ways << " ways";
    }
  }
}
INSTANTIATE_TEST_SUITE_P(StackDistances, EachNumberOfSets, testing::Values(1, 2, 16, 256));

TEST(MissCurve, BeginsWithAllAccessesAndEndsWithFirstUses) {
  const Lines lines = mixed_lines(5'000, 300, 3);
  const MissCurve curve = curve_of(lines, 1);
  Lines distinct = lines;
  std::ranges::sort(distinct);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  EXPECT_EQ(curve.points().front().misses, lines.size());
  EXPECT_EQ(curve.points().back().misses, distinct.size());
  EXPECT_EQ(misses_at(curve.points(), 0), lines.size());
  EXPECT_EQ(misses_at(curve.points(), curve.points().back().ways + 1000), distinct.size());
}

}  // namespace
}  // namespace sheaf
