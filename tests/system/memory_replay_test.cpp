// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Memory traces: recording changes nothing, a replay does what the live machine's memory did, and
// what cannot be replayed is refused.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/tiny_gltf.h"
#include "tracefile/memory_stream.h"
#include "tracefile/trace_metadata.h"

namespace sheaf::test {
namespace {

using Settings = std::vector<std::string>;

const Settings kSmall{"image.width=40", "image.height=36"};

Settings operator+(Settings left, const Settings& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::uint64_t value(const std::filesystem::path& folder, const std::string& key) {
  return read_stats(folder).at(key).at("value").get<std::uint64_t>();
}

/// A counter summed over all units that have this cache.
std::uint64_t sum(const std::filesystem::path& folder, const std::string& suffix) {
  std::uint64_t total = 0;
  const nlohmann::json stats = read_stats(folder);
  for (const auto& [key, entry] : stats.items()) {
    if (key.ends_with("." + suffix)) total += entry.at("value").get<std::uint64_t>();
  }
  return total;
}

class MemoryReplay : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] std::filesystem::path record(const Settings& settings,
                                             const Settings& options = {"--record", "memory"}) {
    const CommandResult result =
        run_sheaf(run_arguments(scene_, scratch_ / "recorded", kSmall + settings) + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return scratch_ / "recorded";
  }
  [[nodiscard]] std::filesystem::path live(const Settings& settings) {
    const CommandResult result =
        run_sheaf(run_arguments(scene_, scratch_ / "live", kSmall + settings));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return scratch_ / "live";
  }
  CommandResult try_replay(const Settings& settings, const std::string& mode = "elastic") {
    Settings arguments{"replay", trace_.string(),           "--quiet", "--mode", mode,
                       "--out",  (scratch_ / mode).string()};
    for (const std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", setting});
    }
    return run_sheaf(arguments);
  }
  [[nodiscard]] std::filesystem::path replay(const Settings& settings,
                                             const std::string& mode = "elastic") {
    const CommandResult result = try_replay(settings, mode);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return scratch_ / mode;
  }
  /// Share by which a replay's length differs from a live run's.
  [[nodiscard]] double error_of(const Settings& memory, const Settings& machine) {
    const auto expected = static_cast<double>(value(live(machine + memory), "system.cycles"));
    const auto found = static_cast<double>(value(replay(memory), "system.cycles"));
    return std::abs(found / expected - 1);
  }
  const std::filesystem::path scene_ = committed_scene(GetParam());
  const ScratchFolder scratch_;
  const std::filesystem::path trace_ = scratch_ / "recorded/memory.trace";
};

TEST_P(MemoryReplay, OfTheRecordingConfigurationTakesItsTime) {
  const std::filesystem::path recorded = record({});
  const auto cycles = static_cast<double>(value(recorded, "system.cycles"));
  for (const char* mode : {"elastic", "fixed"}) {
    const auto found = static_cast<double>(value(replay({}, mode), "system.cycles"));
    EXPECT_NEAR(found / cycles, 1.0, 0.02) << mode;
  }
}

TEST_P(MemoryReplay, OnSlowerMemoryTakesAboutTheTimeOfALiveRun) {
  std::ignore = record({});
  EXPECT_LT(error_of({"dram.latency=400"}, {}), 0.05);
}

// Without sorting, what is accessed does not depend on time.
TEST_P(MemoryReplay, MakesTheAccessesOfALiveRunWhateverTheLines) {
  const Settings machine{"ray_cache.heuristic=none"};
  std::ignore = record(machine);
  const Settings lines{"node_cache.line=32",       "triangle_cache.line=16",
                       "attribute_cache.line=128", "texture_cache.line=256",
                       "film_cache.line=16",       "l2.line=256"};
  const std::filesystem::path expected = live(machine + lines);
  for (const char* mode : {"elastic", "fixed"}) {
    const std::filesystem::path found = replay(lines, mode);
    for (const char* cache : {"node_cache", "triangle_cache", "attribute_cache", "film.cache"}) {
      const std::string counter = std::string(cache) + ".num_accesses";
      EXPECT_EQ(sum(found, counter), sum(expected, counter)) << mode << " " << cache;
    }
  }
}

TEST_P(MemoryReplay, IsTheSameEveryTime) {
  std::ignore = record({});
  const std::string trace = read_bytes(trace_);
  const std::string stats = read_bytes(replay({}) / "stats.json");
  std::ignore = record({});
  EXPECT_EQ(read_bytes(trace_), trace);
  EXPECT_EQ(read_bytes(replay({}) / "stats.json"), stats);
}

TEST_P(MemoryReplay, WorksForEveryKindOfMachine) {
  for (const Settings& machine :
       {Settings{"flow.control=credits", "ray_cache.heuristic=mdir(24)", "ray_cache.timeout=500"},
        Settings{"shader_cache.cells=8", "shader_unit.count=2", "traversal.scheme=single"},
        Settings{"ray_cache.heuristic=opos", "traversal_unit.contexts=1", "film.format=unorm8"}}) {
    const std::filesystem::path recorded = record(machine);
    for (const char* mode : {"elastic", "fixed"}) {
      const auto cycles = static_cast<double>(value(recorded, "system.cycles"));
      const auto found = static_cast<double>(value(replay({}, mode), "system.cycles"));
      EXPECT_NEAR(found / cycles, 1.0, 0.05) << mode << testing::PrintToString(machine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, MemoryReplay, testing::Values("sponza", "oldtree"),
                         [](const auto& scene) { return std::string(scene.param); });

/// Chains of the traversal units of a recorded run that waited for a shader to be done with others.
std::size_t num_chains_behind_shaders(const std::filesystem::path& scene,
                                      const Settings& settings) {
  const ScratchFolder scratch;
  const CommandResult result = run_sheaf(run_arguments(scene, scratch / "run", kSmall + settings) +
                                         Settings{"--record", "memory"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  TraceReader reader(scratch / "run" / "memory.trace");
  const MemoryLayout layout = read_metadata(reader).memory;
  std::size_t found = 0;
  for (std::size_t i = 0; i < layout.streams.size(); ++i) {
    if (layout.streams[i].group != "traversal_unit") continue;
    for (MemoryStream records(reader, layout, i); records.peek() != nullptr; records.pop()) {
      if (!records.peek()->begins) continue;
      const ChainStart& start = records.chain();
      if (start.cause_stream == AccessCause::kAllEarlier) continue;
      if (layout.streams[start.cause_stream].group == "shader_unit" && start.cause_ended) ++found;
    }
  }
  return found;
}

// There are primary rays alone, so that nothing but their room lets a packet wait for a shader.
TEST(MemoryTraceOfCredits, NamesTheRaysWhoseRoomAPacketTook) {
  const ScratchFolder scratch;
  const std::filesystem::path scene = TinyGltf().write(scratch.path());
  const Settings primary{"render.recursion_level=0"};
  EXPECT_EQ(num_chains_behind_shaders(scene, primary), 0U);
  EXPECT_GT(num_chains_behind_shaders(
                scene, primary + Settings{"flow.control=credits", "flow.credits=64"}),
            20U);
}

class MemoryTrace : public MemoryReplay {};

TEST_P(MemoryTrace, ChangesNothingInTheRunThatItIsRecordedFrom) {
  const std::string stats = read_bytes(live({}) / "stats.json");
  EXPECT_EQ(read_bytes(record({}) / "stats.json"), stats);
}

TEST_P(MemoryTrace, IsRefusedWithParametersThatAreNotOfTheMemory) {
  std::ignore = record({});
  for (const char* setting : {"traversal_unit.contexts=3", "ray_cache.heuristic=none",
                              "image.width=41", "film.format=half"}) {
    const CommandResult result = try_replay({setting});
    EXPECT_EQ(result.exit_code, 2) << setting;
    EXPECT_NE(result.err.find("the recorded accesses depend on"), std::string::npos) << result.err;
  }
}

TEST_P(MemoryTrace, IsRefusedWithOptionsThatAreForRays) {
  std::ignore = record({});
  for (const std::string option : {"--scene", "--cache"}) {
    const CommandResult result = run_sheaf({"replay", trace_.string(), option, "here"});
    EXPECT_EQ(result.exit_code, 2) << option;
    EXPECT_NE(result.err.find(option + " is for a trace of rays"), std::string::npos) << result.err;
  }
}

TEST_P(MemoryTrace, CutShortIsReplayedInItsCyclesOnly) {
  std::ignore = record({"run.max_cycles=20000"});
  const CommandResult result = try_replay({});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("cut short"), std::string::npos) << result.err;
  EXPECT_EQ(try_replay({"run.max_cycles=0"}, "fixed").exit_code, 0);
}

TEST_P(MemoryTrace, WithADamagedByteIsRefusedByEveryCommand) {
  std::ignore = record({});
  std::string bytes = read_bytes(trace_);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_bytes(trace_, bytes);
  const std::string trace = trace_.string();
  const std::string out = (scratch_ / "out").string();
  for (const Settings& command :
       {Settings{"replay", trace, "--out", out}, Settings{"curve", trace, "--out", out},
        Settings{"trace", "verify", trace}, Settings{"trace", "export", trace, "--out", out}}) {
    const CommandResult result = run_sheaf(command);
    EXPECT_EQ(result.exit_code, 6) << command[0];
    EXPECT_NE(result.err.find("does not match its checksum"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

TEST_P(MemoryTrace, NeedsSimulatedTime) {
  const CommandResult result = run_sheaf(
      run_arguments(scene_, scratch_ / "recorded", kSmall + Settings{"run.fidelity=functional"}) +
      Settings{"--record", "memory"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--record memory"), std::string::npos) << result.err;
}

TEST_P(MemoryTrace, ThatDoesNotFitOnTheDiskEndsTheRunAndLeavesNoResult) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  const CommandResult result =
      run_sheaf(run_arguments(scene_, scratch_ / "full", kSmall) + Settings{"--record", "memory"});
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("memory.trace: the trace cannot be written"), std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "full"));
}

INSTANTIATE_TEST_SUITE_P(Committed, MemoryTrace, testing::Values("oldtree"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
