// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The signals of a unit add up to its counters.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

using Words = std::vector<std::string>;

struct Change {
  std::uint64_t cycle = 0;
  std::uint64_t value = 0;
};

/// A value change dump, by the names of its signals; its time unit is 1 ps, a cycle 1 ns.
std::map<std::string, std::vector<Change>> read_vcd(const std::filesystem::path& file) {
  std::map<std::string, std::string> names;
  std::map<std::string, std::vector<Change>> signals;
  std::uint64_t cycle = 0;
  bool in_header = true;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first == "$var") {
      std::string type, width, code, name;
      words >> type >> width >> code >> name;
      names[code] = name;
    } else if (first == "$dumpvars") {
      in_header = false;
    } else if (in_header) {
      continue;
    } else if (first.starts_with('#')) {
      const std::uint64_t picoseconds = std::stoull(first.substr(1));
      EXPECT_EQ(picoseconds % 1000, 0U);
      EXPECT_GE(picoseconds / 1000, cycle);
      cycle = picoseconds / 1000;
    } else if (first.starts_with('b')) {
      std::string code;
      words >> code;
      signals[names.at(code)].push_back({cycle, std::stoull(first.substr(1), nullptr, 2)});
    } else if (first.starts_with('0') || first.starts_with('1')) {
      signals[names.at(first.substr(1))].push_back(
          {cycle, static_cast<std::uint64_t>(first[0] - '0')});
    }
  }
  return signals;
}

std::uint64_t cycles_of(const std::vector<Change>& changes, std::uint64_t value,
                        std::uint64_t end) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::uint64_t until = i + 1 == changes.size() ? end : changes[i + 1].cycle;
    if (changes[i].value == value) sum += until - changes[i].cycle;
  }
  return sum;
}

struct WatchedRun {
  explicit WatchedRun(const std::string& unit, const Words& more = {}) {
    Words arguments = run_arguments(committed_scene("dragon"), scratch / "run",
                                    {"image.width=48", "image.height=32"});
    arguments.insert(arguments.end(), {"--vcd", unit});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_sheaf(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    stats = read_stats(scratch / "run");
    signals = read_vcd(file());
  }
  [[nodiscard]] std::filesystem::path file() const { return scratch / "run" / "signals.vcd"; }
  [[nodiscard]] std::uint64_t count(const std::string& path) const {
    return stats.at("system." + path).at("value").get<std::uint64_t>();
  }
  ScratchFolder scratch;
  nlohmann::json stats;
  std::map<std::string, std::vector<Change>> signals;
};

class Vcd : public testing::TestWithParam<const char*> {};

TEST_P(Vcd, StallCauseAddsUpToTheStallAccount) {
  const std::string unit = GetParam();
  const WatchedRun run(unit);
  const std::uint64_t end = run.count("cycles");
  std::uint64_t value = 0;
  for (const char* cause : {"busy", "waiting_input", "waiting_memory", "blocked_output", "idle"}) {
    EXPECT_EQ(cycles_of(run.signals.at("stall_cause"), value, end),
              run.count(unit + ".stall_cycles_" + cause))
        << cause;
    ++value;
  }
}

INSTANTIATE_TEST_SUITE_P(Units, Vcd,
                         testing::Values("primary_source", "packet_arbiter", "traversal_unit1",
                                         "intersection_unit0", "shader_unit0", "ray_cache",
                                         "film"));

TEST(VcdOfAUnit, ShowsPortContextsAndQueues) {
  const WatchedRun run("traversal_unit0");
  const std::uint64_t end = run.count("cycles");
  EXPECT_EQ(cycles_of(run.signals.at("issue_port"), 1, end),
            run.count("traversal_unit0.issue_slots"));
  std::uint64_t most = 0;
  for (const Change& change : run.signals.at("occupancy")) most = std::max(most, change.value);
  EXPECT_GT(most, 1U);
  EXPECT_LE(most, 8U);
  EXPECT_TRUE(run.signals.contains("contexts"));
  EXPECT_TRUE(run.signals.contains("depth_arbiter_to_traversal0"));
}

TEST(VcdOfAUnit, IsTheSameByteForByteAndWithoutADate) {
  const WatchedRun one("film");
  const WatchedRun other("film");
  const std::string bytes = read_bytes(one.file());
  EXPECT_TRUE(bytes == read_bytes(other.file()));
  EXPECT_EQ(bytes.find("$date"), std::string::npos);
}

TEST(VcdOfAUnit, StaysWithinItsWindow) {
  const WatchedRun run("traversal_unit0", {"--timeline-window", "20000..21000"});
  const std::vector<Change>& changes = run.signals.at("issue_port");
  ASSERT_GT(changes.size(), 10U);
  for (const Change& change : changes) {
    if (change.cycle == 0) continue;  // the values before
    EXPECT_GE(change.cycle, 20000U);
    EXPECT_LT(change.cycle, 21000U);
  }
}

TEST(VcdOfAUnit, GoesTogetherWithATimeline) {
  const WatchedRun alone("shader_unit0");
  const WatchedRun both("shader_unit0", {"--timeline"});
  EXPECT_TRUE(read_bytes(alone.file()) == read_bytes(both.file()));
}

}  // namespace
}  // namespace sheaf::test
