// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A timeline tells the same as the counters, and is cut and bounded as it was asked to be.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/read_perfetto.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

using Type = PerfettoEvent::Type;
using Words = std::vector<std::string>;

const char* const kFile = "timeline.perfetto-trace";

/// A run with a timeline, read back.
struct WatchedRun {
  explicit WatchedRun(const Words& settings, const Words& more = {}) {
    Words arguments = run_arguments(committed_scene("dragon"), folder(), small(settings));
    arguments.push_back("--timeline");
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = run_sheaf(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    stats = read_stats(folder());
    trace = read_perfetto(folder() / kFile);
  }
  [[nodiscard]] static Words small(Words settings) {
    settings.insert(settings.begin(), {"image.width=48", "image.height=32"});
    return settings;
  }
  [[nodiscard]] std::filesystem::path folder() const { return scratch / "run"; }
  [[nodiscard]] std::uint64_t count(const std::string& path) const {
    return stats.at(path).at("value").get<std::uint64_t>();
  }
  [[nodiscard]] bool has(const std::string& path) const { return stats.contains(path); }

  ScratchFolder scratch;
  CommandResult result;
  nlohmann::json stats;
  PerfettoTrace trace;
};

struct Slice {
  std::string path, name;
  std::uint64_t begin = 0, end = 0;
  std::uint64_t flow = 0;
  bool ends_flow = false;
};

/// All slices; fails the test where they do not balance, overlap or run backwards.
std::vector<Slice> slices(const PerfettoTrace& trace) {
  std::vector<Slice> all;
  std::map<std::uint64_t, Slice> open;
  std::map<std::uint64_t, std::uint64_t> last;
  for (const PerfettoEvent& event : trace.events) {
    EXPECT_GE(event.at, last[event.track]) << trace.path(event);
    last[event.track] = event.at;
    if (event.type == Type::kBegin) {
      const Slice slice{trace.path(event), event.name, event.at, 0, event.flow, event.ends_flow};
      EXPECT_TRUE(open.emplace(event.track, slice).second) << trace.path(event);
    } else if (event.type == Type::kEnd) {
      const auto it = open.find(event.track);
      EXPECT_NE(it, open.end()) << trace.path(event);
      it->second.end = event.at;
      all.push_back(it->second);
      open.erase(it);
    }
  }
  EXPECT_TRUE(open.empty());
  return all;
}

class Timelines : public testing::TestWithParam<Words> {};

TEST_P(Timelines, SlicesBalanceAndAddUpToTheStallAccounts) {
  const WatchedRun run(GetParam());
  std::map<std::string, std::uint64_t> sums;
  for (const Slice& slice : slices(run.trace)) {
    sums[slice.path + '/' + slice.name] += slice.end - slice.begin;
  }
  int compared = 0;
  for (const auto& [path, entry] : run.stats.items()) {
    const std::size_t at = path.find(".stall_cycles_");
    if (at == std::string::npos || path.ends_with("idle")) continue;
    const std::string cause = path.substr(at + 14);
    const std::string unit = path.substr(7, at - 7);
    const std::string name = cause == "busy"             ? "busy"
                             : cause == "blocked_output" ? "blocked"
                                                         : cause.substr(8);
    EXPECT_EQ(sums[unit + '/' + name], run.count(path)) << path;
    ++compared;
  }
  EXPECT_GE(compared, 8 * 4);
}

TEST_P(Timelines, EveryPacketOfAUnitIsASliceOfItsContexts) {
  const WatchedRun run(GetParam());
  std::map<std::string, std::uint64_t> packets;
  for (const Slice& slice : slices(run.trace)) {
    if (slice.name.starts_with("packet")) ++packets[slice.path.substr(0, slice.path.find('/'))];
  }
  for (const char* unit : {"traversal_unit0", "traversal_unit1", "intersection_unit0",
                           "intersection_unit1", "shader_unit0"}) {
    EXPECT_EQ(packets[unit], run.count(std::string("system.") + unit + ".num_accepted")) << unit;
  }
}

TEST_P(Timelines, CountersReachTheGreatestOccupancyOfTheirLinks) {
  const WatchedRun run(GetParam());
  std::map<std::string, std::int64_t> greatest;
  for (const PerfettoEvent& event : run.trace.events) {
    if (event.type != Type::kValue) continue;
    std::int64_t& most = greatest[run.trace.tracks.at(event.track).name];
    most = std::max(most, event.value);
  }
  for (const auto& [path, entry] : run.stats.items()) {
    if (!path.ends_with(".max_occupancy")) continue;
    std::string link = path.substr(7, path.size() - 7 - 14);
    if (link.starts_with("link.")) link = link.substr(5);
    EXPECT_EQ(greatest.at(link), static_cast<std::int64_t>(run.count(path))) << path;
  }
  EXPECT_EQ(greatest.at("rays_in_loop"),
            static_cast<std::int64_t>(run.count("system.max_rays_in_flight")));
}

INSTANTIATE_TEST_SUITE_P(Machines, Timelines,
                         testing::Values(Words{}, Words{"dram.model=DDR4-2400"},
                                         Words{"ray_cache.heuristic=none", "link.depth=1",
                                               "flow.control=credits", "link.latency=1"},
                                         Words{"packet_fifo.depth=1", "ray_cache.timeout=300"},
                                         Words{"flow.control=spill", "flow.spill_queue=8"}));

TEST(Timeline, LeadsEveryPacketFromWhereItWasMadeToWhereItIsShaded) {
  const WatchedRun run({});
  std::map<std::uint64_t, std::vector<Slice>> ways;
  for (const Slice& slice : slices(run.trace)) {
    if (slice.flow != 0) ways[slice.flow].push_back(slice);
  }
  std::set<std::uint64_t> made;
  for (const PerfettoEvent& event : run.trace.events) {
    if (event.type != Type::kInstant) continue;
    EXPECT_TRUE(made.insert(event.flow).second);
  }
  EXPECT_EQ(ways.size(), run.count("system.shader_unit0.num_accepted"));
  EXPECT_EQ(made.size(), ways.size());
  for (auto& [flow, way] : ways) {
    EXPECT_TRUE(made.contains(flow));
    std::ranges::sort(way, {}, &Slice::begin);
    EXPECT_TRUE(way.front().path.starts_with("traversal_unit"));
    EXPECT_TRUE(way.back().path.starts_with("shader_unit")) << way.back().path;
    for (const Slice& slice : way) EXPECT_EQ(slice.ends_flow, &slice == &way.back());
  }
}

TEST(Timeline, ShowsRowsAndBurstsOfEveryBank) {
  const WatchedRun run({"dram.model=DDR4-2400"});
  std::uint64_t rows = 0;
  std::uint64_t bursts = 0;
  std::uint64_t refreshes = 0;
  for (const Slice& slice : slices(run.trace)) {
    if (!slice.path.starts_with("dram/")) continue;
    if (slice.name.starts_with("row ")) ++rows;
    if (slice.name == "read" || slice.name == "write") ++bursts;
    if (slice.name == "refresh") ++refreshes;
  }
  const std::string channels = "system.dram.channels.";
  EXPECT_EQ(rows, run.count(channels + "num_activates"));
  EXPECT_EQ(bursts,
            run.count(channels + "num_read_bursts") + run.count(channels + "num_write_bursts"));
  EXPECT_EQ(refreshes, run.count(channels + "num_refreshes"));
}

TEST(Timeline, ChangesNoResultButTheSimulatorsOwnWork) {
  const WatchedRun watched({"dram.model=DDR4-2400"});
  const ScratchFolder scratch;
  const auto out = scratch / "plain";
  ASSERT_EQ(run_sheaf(run_arguments(committed_scene("dragon"), out,
                                    WatchedRun::small({"dram.model=DDR4-2400"})))
                .exit_code,
            0);
  nlohmann::json plain = read_stats(out);
  nlohmann::json with_timeline = watched.stats;
  plain.erase("system.num_wakes");
  with_timeline.erase("system.num_wakes");
  EXPECT_EQ(plain, with_timeline);
  EXPECT_EQ(read_bytes(out / "image.exr"), read_bytes(watched.folder() / "image.exr"));
}

TEST(Timeline, IsTheSameByteForByte) {
  const WatchedRun one({});
  const WatchedRun other({});
  EXPECT_TRUE(read_bytes(one.folder() / kFile) == read_bytes(other.folder() / kFile));
}

TEST(Timeline, StaysWithinItsWindow) {
  const WatchedRun run({"dram.model=DDR4-2400"}, {"--timeline-window", "20000..30000"});
  ASSERT_GT(run.trace.events.size(), 1000U);
  for (const PerfettoEvent& event : run.trace.events) {
    EXPECT_GE(event.at, 20000U) << run.trace.path(event);
    EXPECT_LE(event.at, 30000U) << run.trace.path(event);
  }
  slices(run.trace);
}

TEST(Timeline, TakesOneStretchOfSeveral) {
  const WatchedRun run({}, {"--timeline-every", "5"});
  const WatchedRun whole({});
  EXPECT_LT(run.trace.events.size(), whole.trace.events.size() / 3);
  EXPECT_GT(run.trace.events.size(), whole.trace.events.size() / 8);
  for (const PerfettoEvent& event : run.trace.events) {
    EXPECT_LE(event.at % (5 * 4096), 4096U) << run.trace.path(event);
  }
  slices(run.trace);
}

TEST(Timeline, EndsWithItsEventsAndSaysSo) {
  const WatchedRun run({"dram.model=DDR4-2400"}, {"--timeline-events", "5000"});
  EXPECT_LT(run.trace.events.size(), 5000U + 200);
  EXPECT_NE(run.result.err.find("the timeline ends at cycle"), std::string::npos);
  slices(run.trace);
}

TEST(Timeline, OfAPartialRunBalancesToo) {
  const WatchedRun run({"run.max_cycles=5000"});
  EXPECT_FALSE(slices(run.trace).empty());
}

TEST(Timeline, OfAReplayIsThatOfTheRecordedRun) {
  const WatchedRun live({}, {"--record", "rays"});
  const auto replayed = live.scratch / "replay";
  const CommandResult result =
      run_sheaf({"replay", (live.folder() / "rays.trace").string(), "--scene",
                 committed_scene("dragon").string(), "--timeline", "--out", replayed.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(read_bytes(replayed / kFile) == read_bytes(live.folder() / kFile));
}

TEST(Timeline, IsRefusedForAReplayThatSimulatesNoUnits) {
  const ScratchFolder scratch;
  Words arguments =
      run_arguments(committed_scene("dragon"), scratch / "run", WatchedRun::small({}));
  arguments.insert(arguments.end(), {"--record", "memory"});
  ASSERT_EQ(run_sheaf(arguments).exit_code, 0);
  for (const Words& wrong : std::vector<Words>{{"--timeline"}, {"--timeline-every", "2"}}) {
    Words replay{"replay", (scratch / "run" / "memory.trace").string(), "--out",
                 (scratch / "out").string()};
    replay.insert(replay.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(run_sheaf(replay).exit_code, 2) << wrong.front();
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  }
}

TEST(Timeline, RefusesWhatCannotBe) {
  const ScratchFolder scratch;
  for (const Words& wrong :
       std::vector<Words>{{"--timeline", "--set", "run.fidelity=functional"},
                          {"--timeline", "--timeline-window", "5"},
                          {"--timeline", "--timeline-window", "9..9"},
                          {"--timeline", "--timeline-window", "a..b"},
                          {"--timeline", "--timeline-window", "1..99999999999999999999999"},
                          {"--timeline", "--timeline-every", "0"},
                          {"--timeline-every", "2"},
                          {"--vcd", "traversal_unit7"},
                          {"--vcd", "../x"}}) {
    Words arguments =
        run_arguments(committed_scene("dragon"), scratch / "out", WatchedRun::small({}));
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const CommandResult result = run_sheaf(arguments);
    EXPECT_EQ(result.exit_code, 2) << wrong.back();
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << wrong.back();
  }
}

}  // namespace
}  // namespace sheaf::test
