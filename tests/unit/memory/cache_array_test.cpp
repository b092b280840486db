// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Every replacement against a model of it that is written down as its definition reads.

#include "memory/cache_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "base/random.h"

namespace sheaf::test {
namespace {

/// One set by time stamps: LRU and FIFO.
class StampedSet {
 public:
  StampedSet(std::size_t ways, bool on_use) : ways_(ways), on_use_(on_use) {}
  bool touch(std::uint64_t line) {
    const auto found = stamps_.find(line);
    if (found == stamps_.end()) return false;
    if (on_use_) found->second = ++clock_;
    return true;
  }
  std::optional<std::uint64_t> fill(std::uint64_t line) {
    std::optional<std::uint64_t> left;
    if (stamps_.size() == ways_) {
      const auto oldest =
          std::min_element(stamps_.begin(), stamps_.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
      left = oldest->first;
      stamps_.erase(oldest);
    }
    stamps_[line] = ++clock_;
    return left;
  }

 private:
  std::size_t ways_;
  bool on_use_;
  std::uint64_t clock_ = 0;
  std::map<std::uint64_t, std::uint64_t> stamps_;
};

void expect_same(Replacement replacement, bool on_use, std::uint32_t ways) {
  constexpr std::uint64_t kSets = 4;
  CacheArray array(ArrayShape{.sets = kSets, .ways = ways, .replacement = replacement});
  std::vector<StampedSet> model(kSets, StampedSet(ways, on_use));
  Random random(5);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t line = random.below(kSets * ways * 2);
    const bool there = model[line % kSets].touch(line);
    ASSERT_EQ(array.holds(line), there);
    ASSERT_EQ(array.touch(line), there);
    if (there) continue;
    const std::optional<std::uint64_t> left = model[line % kSets].fill(line);
    const CacheArray::Victim victim = array.fill(line, false);
    ASSERT_EQ(victim.valid, left.has_value());
    ASSERT_EQ(victim.line, left.value_or(victim.line));
  }
}

TEST(CacheArray, LruDropsWhatWasUsedLongestAgo) {
  for (const std::uint32_t ways : {1U, 2U, 3U, 8U}) expect_same(Replacement::kLru, true, ways);
}

TEST(CacheArray, FifoDropsWhatCameFirst) {
  for (const std::uint32_t ways : {1U, 2U, 3U, 8U}) expect_same(Replacement::kFifo, false, ways);
}

TEST(CacheArray, PlruOfTwoWaysIsLru) {
  for (const std::uint32_t ways : {1U, 2U}) expect_same(Replacement::kPlru, true, ways);
}

/// The tree of pointers of pseudo-LRU over the ways [begin, end), as nested halves.
class Halves {
 public:
  Halves(std::uint32_t begin, std::uint32_t end) : middle_((begin + end) / 2) {
    if (end - begin == 1) return;
    children_.emplace_back(begin, middle_);
    children_.emplace_back(middle_, end);
  }
  void use(std::uint32_t way) {
    if (children_.empty()) return;
    const std::size_t used = way < middle_ ? 0 : 1;
    next_ = 1 - used;
    children_[used].use(way);
  }
  [[nodiscard]] std::uint32_t victim(std::uint32_t begin) const {
    if (children_.empty()) return begin;
    return children_[next_].victim(next_ == 0 ? begin : middle_);
  }

 private:
  std::uint32_t middle_;
  std::size_t next_ = 0;
  std::vector<Halves> children_;
};

TEST(TreePlru, FollowsThePointersAwayFromWhatWasUsed) {
  for (const std::uint32_t ways : {4U, 16U, 64U}) {
    TreePlru tree(2, ways);
    Halves halves(0, ways);
    Random random(ways);
    for (int i = 0; i < 5000; ++i) {
      ASSERT_EQ(tree.victim(1), halves.victim(0));
      const auto way = static_cast<std::uint32_t>(random.below(ways));
      tree.use(1, way);
      halves.use(way);
      ASSERT_NE(tree.victim(1), way);
    }
    EXPECT_EQ(tree.victim(0), 0U);  // the other set has not been touched
  }
}

TEST(CacheArray, RandomFillsEmptyWaysFirstAndThenDropsAnyAlike) {
  constexpr std::uint32_t kWays = 4;
  CacheArray array(
      ArrayShape{.sets = 1, .ways = kWays, .replacement = Replacement::kRandom, .seed = 9});
  std::vector<std::uint64_t> lines;
  for (std::uint64_t line = 0; line < kWays; ++line) {
    EXPECT_FALSE(array.fill(line, false).valid);
    lines.push_back(line);
  }
  std::vector<int> dropped(kWays);
  constexpr int kFills = 40'000;
  for (int i = 0; i < kFills; ++i) {
    const CacheArray::Victim victim = array.fill(static_cast<std::uint64_t>(i) + kWays, false);
    const auto way = std::find(lines.begin(), lines.end(), victim.line) - lines.begin();
    ASSERT_LT(way, static_cast<std::ptrdiff_t>(kWays));
    ++dropped[static_cast<std::size_t>(way)];
    lines[static_cast<std::size_t>(way)] = static_cast<std::uint64_t>(i) + kWays;
  }
  // Six standard deviations of a binomial count around its mean.
  for (const int count : dropped) EXPECT_NEAR(count, kFills / 4, 6 * 87);
}

TEST(CacheArray, RandomIsTheSameForTheSameSeedOnly) {
  const auto victims = [](std::uint64_t seed) {
    CacheArray array(
        ArrayShape{.sets = 1, .ways = 8, .replacement = Replacement::kRandom, .seed = seed});
    std::vector<std::uint64_t> all;
    for (std::uint64_t line = 0; line < 100; ++line) all.push_back(array.fill(line, false).line);
    return all;
  };
  EXPECT_EQ(victims(1), victims(1));
  EXPECT_NE(victims(1), victims(2));
}

TEST(CacheArray, SectorsOfALineComeOneByOneAndLeaveTogether) {
  for (const Replacement replacement :
       {Replacement::kLru, Replacement::kPlru, Replacement::kFifo, Replacement::kRandom}) {
    CacheArray array(ArrayShape{.sets = 2, .ways = 1, .sectors = 4, .replacement = replacement});
    array.fill(0, false);
    EXPECT_TRUE(array.holds(0));
    EXPECT_FALSE(array.touch(1));
    EXPECT_EQ(array.fill(1, true).dirty, 0U);
    array.fill(3, false);
    EXPECT_TRUE(array.touch(3));
    array.mark_dirty(3);
    const CacheArray::Victim victim = array.fill(8, false);  // line 2, of the same set
    EXPECT_EQ(victim.line, 0U);
    EXPECT_EQ(victim.dirty, 0b1010U);
    for (const std::uint64_t sector : {0, 1, 3}) EXPECT_FALSE(array.holds(sector));
  }
}

TEST(CacheArray, CleaningNamesEveryDirtySectorOnce) {
  for (const std::uint32_t sectors : {1U, 4U}) {
    CacheArray array(ArrayShape{.sets = 4, .ways = 2, .sectors = sectors});
    std::set<std::uint64_t> dirty;
    for (std::uint64_t block = 0; block < 8; ++block) {
      array.fill(block, block % 3 == 0);
      if (block % 3 == 0) dirty.insert(block);
    }
    std::set<std::uint64_t> named;
    array.clean_all([&](std::uint64_t block) { EXPECT_TRUE(named.insert(block).second); });
    EXPECT_EQ(named, dirty);
    array.clean_all([&](std::uint64_t) { FAIL(); });
  }
}

TEST(CacheArray, NoSetsHoldNothing) {
  CacheArray array(ArrayShape{.sets = 0, .ways = 4});
  const CacheArray::Victim victim = array.fill(7, true);
  EXPECT_EQ(victim.line, 7U);
  EXPECT_EQ(victim.dirty, 1U);
  EXPECT_FALSE(array.touch(7));
  EXPECT_FALSE(array.holds(7));
}

}  // namespace
}  // namespace sheaf::test
