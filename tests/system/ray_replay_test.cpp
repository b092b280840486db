// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A ray trace replayed gives what a live run gives, byte for byte, on the machine that recorded it
// and on any other.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "tracefile/ray_block.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_reader.h"
#include "tracefile/trace_writer.h"

namespace sheaf::test {
namespace {

using Settings = std::vector<std::string>;

const Settings kSmall{"image.width=40", "image.height=36", "render.recursion_level=2"};

class RayReplay : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::vector<std::string> arguments = run_arguments(scene_, scratch_ / "recorded", kSmall);
    arguments.insert(arguments.end(), {"--record", "rays"});
    const CommandResult result = run_sheaf(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  [[nodiscard]] CommandResult replay(const Settings& settings, const Settings& options = {}) const {
    std::vector<std::string> arguments{"replay", trace_.string(), "--quiet", "--out",
                                       (scratch_ / "replayed").string()};
    for (const std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", setting});
    }
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_sheaf(arguments);
  }
  void expect_like_live(const Settings& settings) const {
    Settings all = kSmall;
    all.insert(all.end(), settings.begin(), settings.end());
    const CommandResult live = run_sheaf(run_arguments(scene_, scratch_ / "live", all));
    ASSERT_EQ(live.exit_code, 0) << live.err;
    const CommandResult result = replay(settings);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_bytes(scratch_ / "replayed/stats.json"),
              read_bytes(scratch_ / "live/stats.json"))
        << testing::PrintToString(settings);
  }
  const std::filesystem::path scene_ = committed_scene(GetParam());
  const ScratchFolder scratch_;
  const std::filesystem::path trace_ = scratch_ / "recorded/rays.trace";
};

TEST_P(RayReplay, UnderItsOwnConfigurationIsTheRecordedRun) {
  const CommandResult result = replay({});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_bytes(scratch_ / "replayed/stats.json"),
            read_bytes(scratch_ / "recorded/stats.json"));
}

const std::vector<const char*> kHeuristics{"none",     "dir",  "mdir(24)", "fastpos",
                                           "pos(1.0)", "opos", "ray5d(1)", "grid(4)"};
const std::vector<Settings> kMemories{
    {},
    {"dram.latency=700", "dram.bytes_per_cycle=2", "l2.mode=absent"},
    {"node_cache.mode=absent", "texture_cache.capacity=1KiB", "attribute_cache.line=128",
     "l2.line=256", "film.format=half"}};

TEST_P(RayReplay, UnderEveryHeuristicIsALiveRun) {
  std::size_t next_memory = 0;
  for (const char* heuristic : kHeuristics) {
    Settings settings = kMemories[next_memory++ % kMemories.size()];
    settings.push_back(std::string("ray_cache.heuristic=") + heuristic);
    expect_like_live(settings);
  }
}

TEST_P(RayReplay, UnderOtherPacketsAndSchedulesIsALiveRun) {
  const std::vector<Settings> machines{
      {"packet.size=5", "traversal.scheme=single"},
      {"packet.size=64", "flow.control=credits", "shader_unit.count=3"},
      {"run.fidelity=functional", "flow.tile_size=64", "kdtree.max_depth=6"}};
  for (const Settings& settings : machines) expect_like_live(settings);
}

INSTANTIATE_TEST_SUITE_P(Committed, RayReplay, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

class RayTrace : public RayReplay {};

TEST_P(RayTrace, UnderEveryHeuristicOnEachOfThreeMemoriesIsALiveRun) {
  for (const char* heuristic : kHeuristics) {
    for (Settings settings : kMemories) {
      settings.push_back(std::string("ray_cache.heuristic=") + heuristic);
      expect_like_live(settings);
    }
  }
}

TEST_P(RayTrace, IsRefusedOnAnotherScene) {
  const CommandResult result = replay({}, {"--scene", committed_scene("newtree").string()});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("is not the scene that it was recorded from"), std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "replayed"));
}

TEST_P(RayTrace, IsRefusedWithParametersThatShapeItsRays) {
  for (const char* setting : {"image.width=41", "render.recursion_level=3", "scene.reflectance=0.5",
                              "light.position=[0, 1, 0]"}) {
    const CommandResult result = replay({setting});
    EXPECT_EQ(result.exit_code, 2) << setting;
    EXPECT_NE(result.err.find("the recorded rays depend on"), std::string::npos) << result.err;
  }
}

TEST_P(RayTrace, WithADamagedByteIsRefusedBeforeAnythingIsSimulated) {
  std::string bytes = read_bytes(trace_);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_bytes(trace_, bytes);
  const CommandResult result = replay({});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.err.find("does not match its checksum"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "replayed"));
}

TEST_P(RayTrace, ThatDoesNotFitOnTheDiskEndsTheRunAndLeavesNoResult) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::vector<std::string> arguments = run_arguments(scene_, scratch_ / "full", kSmall);
  arguments.insert(arguments.end(), {"--record", "rays"});
  const CommandResult result = run_sheaf(arguments);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("rays.trace: the trace cannot be written"), std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "full"));
}

/// A copy of a trace, each of whose spawned rays has been changed.
void forge(const std::filesystem::path& from, const std::filesystem::path& to,
           const std::function<void(SpawnedRay&)>& change) {
  TraceReader reader(from);
  const TraceMetadata metadata = read_metadata(reader);
  const BlockGrid grid(metadata.width, metadata.height);
  TraceWriter writer(to, reader.identity());
  for (const TraceFrame& frame : reader.frames()) {
    ByteVector raw;
    reader.read(frame, raw);
    RayBlock block;
    decode_ray_block(raw, frame.key, frame.num_records, grid, block);
    std::ranges::for_each(block.children, change);
    encode_ray_block(block, grid, raw);
    writer.add(frame.key, frame.num_records, [raw] { return raw; });
  }
  writer.finish(reader.metadata());
}

TEST_P(RayTrace, WhoseSpawnedRaysAreNoneIsRefusedAsATrace) {
  struct Forgery {
    const char* what;
    std::function<void(SpawnedRay&)> change;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Forgery forgeries[] = {
      {"a weight below zero", [](SpawnedRay& ray) { ray.weight.y = -1e-30F; }},
      {"a weight that is no number", [=](SpawnedRay& ray) { ray.weight.z = nan; }},
      {"no direction", [](SpawnedRay& ray) { ray.direction = Vec3(0.0F); }},
      {"an origin that is no number", [=](SpawnedRay& ray) { ray.origin.x = nan; }},
      {"an end before the beginning", [](SpawnedRay& ray) { ray.t_max = -1.0F; }}};
  const std::filesystem::path forged = scratch_ / "forged.trace";
  for (const Forgery& forgery : forgeries) {
    forge(trace_, forged, forgery.change);
    const CommandResult result = run_sheaf(
        {"replay", forged.string(), "--quiet", "--out", (scratch_ / "replayed").string()});
    EXPECT_EQ(result.exit_code, 6) << forgery.what;
    EXPECT_NE(result.err.find("it spawned a ray that is none"), std::string::npos)
        << forgery.what << ": " << result.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, RayTrace, testing::Values("oldtree"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
