// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "base/errors.h"
#include "sorting/heuristic.h"

namespace sheaf {
namespace {

using Kind = HeuristicChoice::Kind;

TEST(HeuristicChoice, ReadsEveryNameOfThePaper) {
  EXPECT_EQ(HeuristicChoice::parse("none").kind, Kind::kNone);
  EXPECT_EQ(HeuristicChoice::parse("dir").kind, Kind::kDir);
  EXPECT_EQ(HeuristicChoice::parse("fastpos").kind, Kind::kFastpos);
  EXPECT_EQ(HeuristicChoice::parse("opos").kind, Kind::kOpos);
  const HeuristicChoice mdir = HeuristicChoice::parse("mdir(96)");
  EXPECT_EQ(mdir.kind, Kind::kMdir);
  EXPECT_EQ(mdir.x, 96.0);
  const HeuristicChoice pos = HeuristicChoice::parse("pos(2.5e-3)");
  EXPECT_EQ(pos.kind, Kind::kPos);
  EXPECT_EQ(pos.x, 2.5e-3);
}

TEST(HeuristicChoice, ReadsTheNamesOfItsField) {
  const HeuristicChoice ray5d = HeuristicChoice::parse("ray5d(2)");
  EXPECT_EQ(ray5d.kind, Kind::kRay5d);
  EXPECT_EQ(ray5d.x, 2.0);
  const HeuristicChoice grid = HeuristicChoice::parse("grid(8)");
  EXPECT_EQ(grid.kind, Kind::kGrid);
  EXPECT_EQ(grid.x, 8.0);
}

TEST(HeuristicChoice, WritesWhatItReads) {
  for (const char* text : {"none", "dir", "mdir(6)", "mdir(393216)", "fastpos", "pos(0.1)", "opos",
                           "ray5d(3)", "grid(64)"}) {
    EXPECT_EQ(HeuristicChoice::parse(text).to_string(), text);
  }
}

TEST(HeuristicChoice, HasOneNaturalCellForEveryKey) {
  EXPECT_EQ(HeuristicChoice::parse("dir").natural_cells(), 8U);
  EXPECT_EQ(HeuristicChoice::parse("fastpos").natural_cells(), 8U);
  EXPECT_EQ(HeuristicChoice::parse("mdir(216)").natural_cells(), 216U);
  EXPECT_EQ(HeuristicChoice::parse("ray5d(0)").natural_cells(), 6U);
  EXPECT_EQ(HeuristicChoice::parse("ray5d(1)").natural_cells(), 192U);
}

TEST(HeuristicChoice, HasARoundNumberOfCellsWithoutKeysOrWithTooMany) {
  EXPECT_EQ(HeuristicChoice::parse("pos(1)").natural_cells(), 64U);
  EXPECT_EQ(HeuristicChoice::parse("grid(16)").natural_cells(), 64U);
  EXPECT_EQ(HeuristicChoice::parse("ray5d(3)").natural_cells(), 192U);
}

class HeuristicRefusal : public testing::TestWithParam<std::string> {};

TEST_P(HeuristicRefusal, IsOneUsageErrorThatQuotesTheText) {
  try {
    (void)HeuristicChoice::parse(GetParam());
    FAIL() << GetParam() << " was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    const std::string message = error.what();
    EXPECT_NE(message.find("'" + GetParam() + "'"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Texts, HeuristicRefusal,
    testing::Values("", "Dir", "dir ", " dir", "dir(8)", "opos(1)", "mdir", "mdir()", "mdir(96",
                    "mdir(96))", "mdir(96x)", "mdir( 96)", "mdir(0)", "mdir(-96)", "mdir(5)",
                    "mdir(95)", "mdir(96.5)", "mdir(nan)", "mdir(inf)", "mdir(396294)",
                    "mdir(1e300)", "pos", "pos()", "pos(0)", "pos(-1)", "pos(nan)", "pos(inf)",
                    "pos(1e999)", "pos(0x1)", "pos(1,0)", "(1)", "none()", "ray5d", "ray5d(-1)",
                    "ray5d(4)", "ray5d(0.5)", "grid(0)", "grid(65)", "grid(2.5)", "grid(nan)"));

}  // namespace
}  // namespace sheaf
