// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Bad input gets one clear line and an exit code that tells whose fault it is, and leaves the
// results as they were.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "support/read_exr.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/tiny_gltf.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// All files below a folder with their bytes; empty if there is none.
std::map<std::string, std::string> content(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    files[entry.path()] = entry.is_regular_file() ? read_bytes(entry.path()) : "folder";
  }
  return files;
}

class BadInput : public testing::Test {
 protected:
  /// Refused with neither a new folder nor a change to a former result.
  void expect_no_trace(const fs::path& scene, const std::vector<std::string>& settings,
                       ExitCode code, const Words& words) {
    expect_refusal(run_sheaf(run_arguments(scene, scratch_ / "new/result", settings)), code, words);
    EXPECT_FALSE(fs::exists(scratch_ / "new"));
    const fs::path former = scratch_ / "former";
    if (!fs::exists(former)) {
      const fs::path good = TinyGltf().write(scratch_.path(), "good");
      ASSERT_EQ(run_sheaf(run_arguments(good, former, kTinyImage)).exit_code, 0);
    }
    const auto before = content(former);
    ASSERT_EQ(before.size(), 5U);
    expect_refusal(run_sheaf(run_arguments(scene, former, settings)), code, words);
    EXPECT_EQ(content(former), before);
  }

  void expect_scene_refused(const fs::path& scene, const Words& words) {
    expect_no_trace(scene, kTinyImage, ExitCode::kScene, words);
  }
  void expect_setting_refused(const std::string& setting, const Words& words) {
    expect_no_trace(TinyGltf().write(scratch_.path()), {setting}, ExitCode::kUsage, words);
  }
  void expect_config_refused(const std::string& toml, const Words& words) {
    write_bytes(scratch_ / "bad.toml", toml);
    const fs::path out = scratch_ / "result";
    std::vector<std::string> arguments =
        run_arguments(TinyGltf().write(scratch_.path()), out, kTinyImage);
    arguments.insert(arguments.end(), {"--config", (scratch_ / "bad.toml").string()});
    expect_refusal(run_sheaf(arguments), ExitCode::kUsage, words);
    EXPECT_FALSE(fs::exists(out));
  }
  void expect_output_refused(const fs::path& out, const Words& words) {
    const fs::path scene = TinyGltf().write(scratch_.path());
    expect_refusal(run_sheaf(run_arguments(scene, out, kTinyImage)), ExitCode::kOutput, words);
  }

  inline static const std::vector<std::string> kTinyImage{"image.width=8", "image.height=8"};
  const ScratchFolder scratch_;
};

TEST_F(BadInput, MissingFile) {
  expect_scene_refused(scratch_ / "nowhere.glb", {"nowhere.glb"});
}

TEST_F(BadInput, FolderInsteadOfAFile) {
  expect_scene_refused(scratch_.path(), {scratch_.path()});
}

TEST_F(BadInput, EmptyFile) {
  write_bytes(scratch_ / "empty.glb", "");
  expect_scene_refused(scratch_ / "empty.glb", {"empty.glb"});
}

TEST_F(BadInput, NotAGltf) {
  write_bytes(scratch_ / "notes.gltf", "These are the notes of a meeting.\n");
  expect_scene_refused(scratch_ / "notes.gltf", {"notes.gltf"});
}

TEST_F(BadInput, TruncatedGlb) {
  const std::string whole = read_bytes(committed_scene("sponza"));
  for (const std::size_t size : {std::size_t{4}, std::size_t{11}, std::size_t{19}, std::size_t{100},
                                 whole.size() / 2, whole.size() - 1}) {
    write_bytes(scratch_ / "cut.glb", whole.substr(0, size));
    expect_scene_refused(scratch_ / "cut.glb", {"cut.glb"});
  }
}

TEST_F(BadInput, AccessorPastItsBuffer) {
  TinyGltf tiny;
  tiny.json["accessors"][0]["count"] = 9;
  expect_scene_refused(tiny.write(scratch_.path()), {"tiny.gltf", "/accessors/0"});
}

TEST_F(BadInput, BufferFileTooShort) {
  const fs::path file = TinyGltf().write(scratch_.path());
  write_bytes(scratch_ / "tiny.bin", "short");
  expect_scene_refused(file, {"tiny.gltf", "/buffers/0"});
}

TEST_F(BadInput, IndexOutOfRange) {
  TinyGltf tiny;
  tiny.indices[7] = 8;
  expect_scene_refused(tiny.write(scratch_.path()), {"tiny.gltf", "8"});
}

TEST_F(BadInput, UnknownRequiredExtension) {
  TinyGltf tiny;
  tiny.json["extensionsUsed"] = {"ACME_teapots"};
  tiny.json["extensionsRequired"] = {"ACME_teapots"};
  expect_scene_refused(tiny.write(scratch_.path()), {"tiny.gltf", "ACME_teapots"});
}

TEST_F(BadInput, Draco) {
  TinyGltf tiny;
  tiny.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  tiny.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  expect_scene_refused(tiny.write(scratch_.path()),
                       {"tiny.gltf", "KHR_draco_mesh_compression", "gltf-transform"});
}

TEST_F(BadInput, NoTriangles) {
  TinyGltf tiny;
  tiny.json["scenes"][0]["nodes"] = nlohmann::json::array();
  expect_scene_refused(tiny.write(scratch_.path()), {"tiny.gltf", "triangle"});
}

TEST_F(BadInput, VertexThatIsNotFinite) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    TinyGltf tiny;
    tiny.positions[4] = bad;
    expect_scene_refused(tiny.write(scratch_.path()), {"tiny.gltf", "/accessors/0"});
  }
}

TEST_F(BadInput, UnknownKeyNamesTheNearest) {
  expect_setting_refused("ray_cache.cell=8", {"ray_cache.cell", "ray_cache.cells"});
  expect_config_refused("[ray_cache]\ncells = 8\nheuristik = \"dir\"\n",
                        {"bad.toml:3", "ray_cache.heuristik", "ray_cache.heuristic"});
}

TEST_F(BadInput, ValueOutOfRange) {
  expect_setting_refused("packet.size=65", {"packet.size", "65", "1 to 64"});
  expect_setting_refused("packet.size=0", {"packet.size", "1 to 64"});
  expect_setting_refused("dram.latency=-1", {"dram.latency"});
  expect_setting_refused("clock.frequency=nan", {"clock.frequency"});
  expect_config_refused("[image]\nwidth = 100000\n", {"bad.toml:2", "image.width", "100000"});
}

TEST_F(BadInput, ValueOfTheWrongKind) {
  expect_setting_refused("packet.size=many", {"packet.size", "many"});
  expect_setting_refused("ray_cache.heuristic=sideways", {"ray_cache.heuristic", "sideways"});
  expect_config_refused("[packet\nsize = 16\n", {"bad.toml:1"});
}

TEST_F(BadInput, CombinationThatCannotBe) {
  expect_setting_refused("l2.line=96", {"l2.line", "power of two"});
  expect_setting_refused("node_cache.line=48", {"node_cache.line", "power of two"});
  expect_setting_refused("node_cache.capacity=20000", {"node_cache.capacity"});
  expect_setting_refused("flow.tile_size=3", {"flow.tile_size", "packet.size"});
}

TEST_F(BadInput, CreditsThatAdmitNoPacket) {
  expect_no_trace(committed_scene("sponza"),
                  {"flow.control=credits", "flow.credits=16", "image.width=8", "image.height=8"},
                  ExitCode::kUsage, {"flow.credits"});
}

// Cycles of a millisecond each: SystemC's 64 bits of picoseconds are over before the frame is.
TEST_F(BadInput, ClockTooSlowForTheFrame) {
  expect_no_trace(committed_scene("sponza"),
                  {"clock.frequency=1kHz", "traversal_unit.initiation_interval=1000000",
                   "traversal_unit.count=1", "traversal_unit.lanes=1"},
                  ExitCode::kUsage, {"clock.frequency", "choose a faster clock"});
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  write_bytes(scratch_ / "file", "a user's own");
  expect_output_refused(scratch_ / "file", {"file"});
  expect_output_refused(scratch_ / "file/below", {"file/below"});
  EXPECT_EQ(read_bytes(scratch_ / "file"), "a user's own");
  expect_output_refused("/proc/sheaf", {"/proc/sheaf"});
}

TEST_F(BadInput, FolderWithOtherThingsInIt) {
  fs::create_directory(scratch_ / "thesis");
  write_bytes(scratch_ / "thesis/chapter1.txt", "It was a dark and stormy night.");
  expect_output_refused(scratch_ / "thesis", {"thesis"});
  EXPECT_EQ(content(scratch_ / "thesis").size(), 1U);
}

TEST_F(BadInput, WrongArguments) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"run"}, {"simulate"}, {"run", "a.glb", "--fast"}}) {
    expect_refusal(run_sheaf(arguments), ExitCode::kUsage, {});
  }
}

class Interrupted : public BadInput, public testing::WithParamInterface<const char*> {
 protected:
  static constexpr std::chrono::milliseconds kPoll{5};
  static constexpr int kMostPolls = 12'000;

  /// Starts a long run and ends it by `signal_number` once it has opened its folder and has used so
  /// much processor time.
  [[nodiscard]] CommandResult interrupt_run(int signal_number, std::chrono::milliseconds work) {
    const std::vector<std::string> long_run{"render.recursion_level=30",
                                            std::string("run.fidelity=") + GetParam()};
    return run_sheaf(run_arguments(committed_scene("sponza"), result_, long_run), [&](pid_t run) {
      const auto waits = [&] { return !fs::exists(result_) || processor_time(run) < work; };
      for (int i = 0; i < kMostPolls && waits(); ++i) std::this_thread::sleep_for(kPoll);
      kill(run, signal_number);
    });
  }

  /// What a process has used so far, by fields 14 and 15 of its status (proc(5)).
  static std::chrono::milliseconds processor_time(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string skipped;
    for (int field = 1; field < 14; ++field) status >> skipped;
    long user = 0;
    long system = 0;
    status >> user >> system;
    return std::chrono::milliseconds(1000 * (user + system) / sysconf(_SC_CLK_TCK));
  }

  void expect_partial_result(const CommandResult& result) {
    expect_refusal(result, ExitCode::kInterrupted, {"partial"});
    const nlohmann::json stats = read_stats(result_);
    EXPECT_EQ(stats.at("run.complete").at("value"), 0);
    EXPECT_LT(stats.at("rays.primary.depth0.num_spawned").at("value"), 640 * 480);
    EXPECT_NE(read_bytes(result_ / "summary.txt").find("PARTIAL"), std::string::npos);
    EXPECT_EQ(read_exr(result_ / "image.exr").width, 640U);
  }

  const fs::path result_ = scratch_ / "result";
};

TEST_P(Interrupted, ByCtrlCKeepsAPartialResult) {
  using namespace std::chrono_literals;
  const CommandResult result = interrupt_run(SIGINT, 3000ms);
  expect_partial_result(result);
  EXPECT_GT(read_stats(result_).at("rays.num_retired").at("value"), 0);
}

TEST_P(Interrupted, ByCtrlCWhileTheSceneIsLoaded) {
  using namespace std::chrono_literals;
  expect_partial_result(interrupt_run(SIGINT, 0ms));
}

TEST_P(Interrupted, ByTerminationKeepsAPartialResult) {
  using namespace std::chrono_literals;
  expect_partial_result(interrupt_run(SIGTERM, 700ms));
}

INSTANTIATE_TEST_SUITE_P(Fidelity, Interrupted, testing::Values("timed", "functional"),
                         [](const auto& fidelity) { return std::string(fidelity.param); });

TEST_F(BadInput, MaxCyclesMarksTheResultAsPartial) {
  const CommandResult result =
      run_sheaf(run_arguments(committed_scene("sponza"), scratch_ / "result",
                              {"image.width=64", "image.height=48", "run.max_cycles=10000"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("partial"), std::string::npos);
  EXPECT_EQ(read_stats(scratch_ / "result").at("run.complete").at("value"), 0);
  EXPECT_LE(read_stats(scratch_ / "result").at("system.cycles").at("value"), 10000);
}

}  // namespace
}  // namespace sheaf::test
