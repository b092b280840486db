// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <sstream>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

using Rows = std::vector<std::map<std::string, std::string>>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

Rows read_csv(const std::filesystem::path& file) {
  std::istringstream stream(read_bytes(file));
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = cells_of(line);
  Rows rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    EXPECT_EQ(cells.size(), names.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) rows.back()[names[i]] = cells[i];
  }
  return rows;
}

std::vector<std::string> arguments(const std::filesystem::path& out,
                                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"accuracy", committed_scene("fairy").string(), "--out",
                               out.string()};
  for (const char* setting : {"image.width=32", "image.height=24", "render.recursion_level=1"}) {
    all.emplace_back("--set");
    all.emplace_back(setting);
  }
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(AccuracyCommand, ComparesEveryLevelWithTheReference) {
  const ScratchFolder scratch;
  const CommandResult result = run_sheaf(arguments(scratch / "out"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Rows rows = read_csv(scratch / "out" / "accuracy.csv");
  ASSERT_EQ(rows.size(), 9U);
  EXPECT_EQ(rows.front().at("level"), "analytic");
  EXPECT_EQ(rows.back().at("level"), "clocked");
  EXPECT_EQ(rows.back().at("cycles_error"), "0");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("reference"), "clocked");
    EXPECT_GT(std::stod(row.at("processor_seconds")), 0.0);
    EXPECT_GT(std::stod(row.at("cycles")), 0.0);
    EXPECT_NE(row.at("p_t_secondary_error"), "");
  }
  for (const char* limit : {"within 1 %", "within 2 %", "within 5 %"}) {
    EXPECT_NE(result.out.find(limit), std::string::npos);
  }
  for (const char* name : {"accuracy.svg", "image_error.svg"}) {
    EXPECT_NE(read_bytes(scratch / "out" / name).find("<svg"), std::string::npos);
  }
}

TEST(AccuracyCommand, FindsThePapersExampleLostInEightBits) {
  const ScratchFolder scratch;
  ASSERT_EQ(run_sheaf(arguments(scratch / "out", {"--reference", "timed"})).exit_code, 0);
  const Rows rows = read_csv(scratch / "out" / "image_error.csv");
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows[4].at("picture"), "1000 rays of weight 0.001");
  EXPECT_EQ(rows[4].at("film"), "unorm8");
  EXPECT_EQ(rows[4].at("rmse"), "1");  // nothing of the light arrives
  EXPECT_EQ(rows[7].at("film"), "exact");
  EXPECT_EQ(rows[7].at("rmse"), "0");
  EXPECT_GT(std::stod(rows[0].at("rel_mse")), std::stod(rows[1].at("rel_mse")));
  EXPECT_GT(std::stod(rows[1].at("rel_mse")), std::stod(rows[2].at("rel_mse")));
}

TEST(AccuracyCommand, LosesNoHitInFewerBits) {
  const ScratchFolder scratch;
  const CommandResult result = run_sheaf(arguments(scratch / "out", {"--reference", "timed"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Rows rows = read_csv(scratch / "out" / "precision.csv");
  ASSERT_EQ(rows.size(), 13U);
  EXPECT_EQ(rows[0].at("stored"), "nothing");
  EXPECT_EQ(rows[0].at("steps_added"), "0");
  for (const auto& row : rows) {
    EXPECT_GT(std::stoul(row.at("rays")), 32U * 24U);
    EXPECT_EQ(row.at("other_hits"), "0");
    EXPECT_EQ(row.at("rmse"), "0");
  }
  EXPECT_EQ(rows[12].at("stored"), "both");
  EXPECT_EQ(rows[12].at("format"), "fixed 8");
  EXPECT_EQ(rows[12].at("node_bits_saved"), "24");
  EXPECT_EQ(rows[12].at("ray_bits_saved"), "144");
  EXPECT_GT(std::stod(rows[12].at("steps_added")), std::stod(rows[3].at("steps_added")));
  EXPECT_NE(result.out.find("planes and rays in fewer bits"), std::string::npos);
}

TEST(AccuracyCommand, SaysTheSameTwiceButForTimes) {
  const ScratchFolder scratch;
  for (const char* name : {"a", "b"}) {
    ASSERT_EQ(run_sheaf(arguments(scratch / name, {"--reference", "timed"})).exit_code, 0);
  }
  for (const char* file : {"image_error.csv", "precision.csv"}) {
    EXPECT_EQ(read_bytes(scratch / "a" / file), read_bytes(scratch / "b" / file));
  }
  Rows a = read_csv(scratch / "a" / "accuracy.csv");
  Rows b = read_csv(scratch / "b" / "accuracy.csv");
  for (Rows* rows : {&a, &b}) {
    for (auto& row : *rows) {
      for (const char* time : {"processor_seconds", "wall_seconds", "pareto"}) row.erase(time);
    }
  }
  EXPECT_EQ(a, b);
}

TEST(AccuracyCommand, ReplacesItsOwnResultAndNothingElse) {
  const ScratchFolder scratch;
  const std::vector<std::string> timed{"--reference", "timed"};
  ASSERT_EQ(run_sheaf(arguments(scratch / "out", timed)).exit_code, 0);
  EXPECT_EQ(run_sheaf(arguments(scratch / "out", timed)).exit_code, 0);
  std::ofstream(scratch / "file") << "mine";
  EXPECT_EQ(run_sheaf(arguments(scratch.path(), timed)).exit_code, 4);
}

TEST(AccuracyCommand, RefusesWhatItCannotCompare) {
  const ScratchFolder scratch;
  EXPECT_EQ(run_sheaf(arguments(scratch / "out", {"--reference", "analytic"})).exit_code, 2);
  const CommandResult partial =
      run_sheaf(arguments(scratch / "out", {"--set", "run.max_cycles=100"}));
  EXPECT_EQ(partial.exit_code, 2);
  EXPECT_NE(partial.err.find("run.max_cycles"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(AccuracyCommand, LeavesOutWhatCannotBeFormedWhereNoRayMeetsTheScene) {
  const ScratchFolder scratch;
  const CommandResult result = run_sheaf(
      arguments(scratch / "out", {"--reference", "timed", "--set", "camera.position=[0,1000,0]",
                                  "--set", "camera.look_at=[0,2000,1]"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" - "), std::string::npos) << result.out;
  for (const auto& row : read_csv(scratch / "out" / "accuracy.csv")) {
    EXPECT_EQ(row.at("p_t_primary_error"), "");
    EXPECT_EQ(row.at("p_t_secondary_error"), "");
  }
}

}  // namespace
}  // namespace sheaf::test
