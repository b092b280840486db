// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A command that is stopped before it has a result leaves nothing behind, and says so in one line.

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "base/errors.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/simulate.h"
#include "system/coherence.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;

void wait_for(const std::function<bool()>& what) {
  for (int i = 0; i < 12'000 && !what(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
}

/// Runs a command with this folder for its results, and stops it once that is there.
CommandResult interrupt(std::vector<std::string> command, const fs::path& out, int signal) {
  command.insert(command.end(), {"--out", out.string()});
  return run_sheaf(command, [&](pid_t run) {
    wait_for([&] { return fs::exists(out); });
    kill(run, signal);
  });
}

void expect_stopped(const CommandResult& result, const fs::path& out) {
  EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::kInterrupted));
  EXPECT_TRUE(result.err.starts_with("sheaf: stopped ")) << result.err;
  EXPECT_TRUE(result.err.ends_with("; nothing is written\n")) << result.err;
  EXPECT_FALSE(fs::exists(out));
}

TEST(Interrupt, OfACurveLeavesNothing) {
  const ScratchFolder scratch;
  const fs::path trace =
      committed_scene("sponza").parent_path().parent_path() / "traces/dragon-memory.trace";
  std::vector<std::string> command{"curve", trace.string()};
  for (int bits = 0; bits < 12; ++bits) {  // 144 shapes
    command.insert(command.end(),
                   {"--line", std::to_string(1 << bits), "--sets", std::to_string(1 << bits)});
  }
  expect_stopped(interrupt(command, scratch / "out", SIGINT), scratch / "out");
}

TEST(Interrupt, OfTheCatalogueLeavesNothing) {
  const ScratchFolder scratch;
  expect_stopped(interrupt({"stability", "--quick", "--only", "rays/"}, scratch / "out", SIGTERM),
                 scratch / "out");
}

TEST(Interrupt, OfAccuracyBeforeItsFirstLevelLeavesNothing) {
  const ScratchFolder scratch;
  expect_stopped(interrupt({"accuracy", committed_scene("fairy").string(), "--set",
                            "image.width=2000", "--set", "image.height=2000"},
                           scratch / "out", SIGINT),
                 scratch / "out");
}

TEST(Interrupt, OfTheCoherencePassIsHeardAtTheNextPacket) {
  const TestScene scene(committed_scene("sponza"), {"image.width=16", "image.height=16"});
  CoherencePass whole(scene.base(), scene.prepared());
  int packets = 0;
  EXPECT_TRUE(whole.run([&] { return packets++, false; }));
  EXPECT_EQ(packets, 16 * 16 / 16);
  CoherencePass stopped(scene.base(), scene.prepared());
  packets = 0;
  EXPECT_FALSE(stopped.run([&] { return ++packets == 3; }));
  EXPECT_EQ(packets, 3);
  EXPECT_LT(stopped.primary().s_t, whole.primary().s_t);
}

/// A child of a process; 0 if it has none.
pid_t child_of(pid_t parent) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    pid_t process = 0;
    pid_t its_parent = 0;
    std::string name;
    std::string state;
    if (stat >> process >> name >> state >> its_parent && its_parent == parent) return process;
  }
  return 0;
}

CommandResult end_level(int signal) {
  const ScratchFolder scratch;
  return run_sheaf({"accuracy", committed_scene("fairy").string(), "--set", "image.width=2000",
                    "--set", "image.height=2000", "--out", (scratch / "out").string()},
                   [&](pid_t run) {
                     wait_for([&] { return child_of(run) != 0; });
                     kill(child_of(run), signal);
                   });
}

TEST(Interrupt, OfALevelByTheSystemIsNoBug) {
  const CommandResult result = end_level(SIGKILL);
  EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::kUsage));
  EXPECT_NE(result.err.find("signal 9 (Killed); if for want of memory, choose a smaller"),
            std::string::npos)
      << result.err;
}

// As of a failed assertion; sanitizers take other signals of a crash for themselves.
TEST(Interrupt, OfALevelByACrashIsABug) {
  const CommandResult result = end_level(SIGABRT);
  EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::kBug));
  EXPECT_NE(result.err.find("a bug of the simulator"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace sheaf::test
