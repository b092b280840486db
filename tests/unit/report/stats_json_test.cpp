// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/stats_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace sheaf {
namespace {

StatsTree sample() {
  StatsTree tree;
  tree.add("system.b", std::numeric_limits<std::uint64_t>::max(), "rays", "");
  tree.add_real("system.a", 0.1, "1", "");
  tree.add_ratio("system.none", 0, 0, "1", "");
  tree.add_text("run.scene", "a \"quoted\" n\xc3\xa4me\n", "");
  return tree;
}

TEST(StatsJson, WritesOneEntryALineInTheOrderOfTheTree) {
  EXPECT_EQ(
      stats_json(sample()),
      "{\n"
      "  \"system.b\": {\"value\": 18446744073709551615, \"unit\": \"rays\"},\n"
      "  \"system.a\": {\"value\": 0.1, \"unit\": \"1\"},\n"
      "  \"system.none\": {\"value\": null, \"unit\": \"1\"},\n"
      "  \"run.scene\": {\"value\": \"a \\\"quoted\\\" n\xc3\xa4me\\n\", \"unit\": \"text\"}\n"
      "}\n");
}

TEST(StatsJson, ReadsBackExactly) {
  StatsTree tree = sample();
  const double real = 1.0 / 3;
  tree.add_real("third", real, "1", "");
  tree.add_real("tiny", std::numeric_limits<double>::denorm_min(), "1", "");
  const auto json = nlohmann::json::parse(stats_json(tree));
  EXPECT_EQ(json.size(), tree.entries().size());
  EXPECT_EQ(json.at("system.b").at("value").get<std::uint64_t>(), 18446744073709551615U);
  EXPECT_EQ(json.at("third").at("value").get<double>(), real);
  EXPECT_EQ(json.at("tiny").at("value").get<double>(), std::numeric_limits<double>::denorm_min());
}

TEST(StatsJson, AWholeRealStaysAReal) {
  StatsTree tree;
  tree.add_ratio("two", 4, 2, "1", "");
  EXPECT_NE(stats_json(tree).find("2.0"), std::string::npos);
}

TEST(StatsJson, NamesThatAreNotUtf8DoNotStopTheReport) {
  StatsTree tree;
  tree.add_text("run.scene", "\xff", "");
  EXPECT_EQ(nlohmann::json::parse(stats_json(tree)).at("run.scene").at("value"), "\xef\xbf\xbd");
}

TEST(StatsJson, AnEmptyTreeIsAnEmptyObject) {
  EXPECT_TRUE(nlohmann::json::parse(stats_json(StatsTree{})).empty());
}

}  // namespace
}  // namespace sheaf
