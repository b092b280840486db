// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Hits equal Embree's: the same primitive at the same distance, for random, primary and secondary
// rays over every committed scene and the real Sponza.

#include <gtest/gtest.h>

#include <iostream>

#include "config/read_config.h"
#include "support/scenes.h"
#include "system/hit_comparison.h"

namespace sheaf::test {
namespace {

constexpr std::uint64_t kRaysOfAKind = 1'000'000;

void compare_hits(const std::filesystem::path& file) {
  HitComparison comparison(file, resolve_config({}, {}));
  comparison.random_rays(kRaysOfAKind);
  comparison.primary_and_secondary_rays(kRaysOfAKind);
  EXPECT_EQ(comparison.tallies().size(), 3U);
  for (const auto& [kind, tally] : comparison.tallies()) {
    EXPECT_GE(tally.rays, kRaysOfAKind) << kind;
    EXPECT_GE(tally.hits * 50, tally.rays) << kind << " rays hardly hit anything";
    EXPECT_EQ(tally.unexplained, 0U) << kind;
  }
  std::cout << comparison.text();
}

class Hits : public testing::TestWithParam<const char*> {};

TEST_P(Hits, EqualEmbrees) {
  compare_hits(committed_scene(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Committed, Hits, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(HitsOfTheRealSponza, EqualEmbrees) {
  const auto file = real_sponza();
  if (!file) GTEST_SKIP() << "the real Sponza is not here; SHEAF_REAL_SPONZA tells where it is";
  compare_hits(*file);
}

}  // namespace
}  // namespace sheaf::test
