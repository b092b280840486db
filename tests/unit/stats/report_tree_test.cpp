// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/report_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "stats/stall_account.h"

namespace sheaf {
namespace {

bool is_none(const StatsTree& tree, const std::string& path) {
  return std::holds_alternative<std::monostate>(tree.find(path)->value);
}

TEST(StatsTree, KeepsTheOrderOfAdding) {
  StatsTree tree;
  tree.add("z", 1, "rays", "");
  tree.add_text("a", "text", "");
  tree.add_real("m", 0.5, "1", "");
  ASSERT_EQ(tree.entries().size(), 3U);
  EXPECT_EQ(tree.entries()[0].path, "z");
  EXPECT_EQ(tree.entries()[1].path, "a");
  EXPECT_EQ(tree.entries()[2].path, "m");
}

TEST(StatsTree, CountsStayExactTo64Bits) {
  StatsTree tree;
  tree.add("n", std::numeric_limits<std::uint64_t>::max(), "rays", "");
  EXPECT_EQ(tree.count("n"), 18446744073709551615U);
}

TEST(StatsTree, ARatioOfNothingIsNone) {
  StatsTree tree;
  tree.add_ratio("zero", 0, 0, "1", "");
  tree.add_ratio("infinite", 1, 0, "1", "");
  tree.add_ratio("half", std::uint64_t{1}, std::uint64_t{2}, "1", "");
  EXPECT_TRUE(is_none(tree, "zero"));
  EXPECT_TRUE(is_none(tree, "infinite"));
  EXPECT_EQ(std::get<double>(tree.find("half")->value), 0.5);
}

TEST(StatsTree, WhatIsNotKnownIsNone) {
  StatsTree tree;
  tree.add_real("unknown", std::nullopt, "1", "");
  EXPECT_TRUE(is_none(tree, "unknown"));
}

TEST(StatsTree, NanOrInfinityIsABug) {
  StatsTree tree;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(tree.add_real("nan", kNan, "1", ""), std::logic_error);
  EXPECT_THROW(tree.add_real("inf", -std::numeric_limits<double>::infinity(), "1", ""),
               std::logic_error);
  EXPECT_THROW(tree.add_ratio("overflow", 1e300, 1e-300, "1", ""), std::logic_error);
  EXPECT_THROW(tree.add_ratio("nan", kNan, 1.0, "1", ""), std::logic_error);
  EXPECT_TRUE(tree.entries().empty());
}

TEST(StatsTree, APathStandsOnce) {
  StatsTree tree;
  tree.add("n", 1, "rays", "");
  EXPECT_THROW(tree.add("n", 2, "rays", ""), std::logic_error);
  EXPECT_THROW(tree.add_text("n", "", ""), std::logic_error);
}

TEST(StatsTree, UnknownPathsAndOtherTypesAreNoCounts) {
  StatsTree tree;
  tree.add_real("r", 1.0, "1", "");
  EXPECT_THROW(static_cast<void>(tree.count("n")), std::out_of_range);
  EXPECT_THROW(static_cast<void>(tree.count("r")), std::out_of_range);
  EXPECT_EQ(tree.find("n"), nullptr);
}

TEST(StatsTree, CountersComeWithUnitAndMeaning) {
  StallAccount account;
  account.switch_to(StallCause::kBusy, 10);
  account.finish(25);
  StatsTree tree;
  tree.add_counters("system.unit", account);
  EXPECT_EQ(tree.entries().size(), kNumStallCauses);
  EXPECT_EQ(tree.count("system.unit.stall_cycles_busy"), 15U);
  EXPECT_EQ(tree.count("system.unit.stall_cycles_idle"), 10U);
  EXPECT_EQ(tree.find("system.unit.stall_cycles_busy")->unit, "cycles");
  EXPECT_FALSE(tree.find("system.unit.stall_cycles_busy")->meaning.empty());
}

}  // namespace
}  // namespace sheaf
