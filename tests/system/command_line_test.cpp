// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The command line: what is printed arrives or the command fails, no option is passed over in
// silence, and a refusal is one line that names the word and the remedy.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/tiny_gltf.h"

namespace sheaf::test {
namespace {

using Words = std::vector<std::string>;

std::string committed_trace(const std::string& name) {
  return (committed_scene("sponza").parent_path().parent_path() / "traces" / (name + ".trace"))
      .string();
}

Words operator+(Words left, const Words& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

TEST(Output, ThatDoesNotArriveIsAFailure) {
  const ScratchFolder scratch;
  const std::string scene = TinyGltf().write(scratch.path()).string();
  for (const Words& command :
       std::vector<Words>{{"config"},
                          {"config", "--schema"},
                          {"counters"},
                          {"coefficients"},
                          {"--help"},
                          {"run", "--help"},
                          {"--version"},
                          {"info", scene},
                          {"trace", "info", committed_trace("dragon-memory")},
                          {"trace", "verify", committed_trace("dragon-memory")},
                          {"memory", "--generate", "random", "--count", "10"},
                          {"run", scene, "--set", "image.width=8", "--set", "image.height=8",
                           "--out", (scratch / "run").string()}}) {
    SCOPED_TRACE(testing::PrintToString(command));
    expect_refusal(run_sheaf_into("/dev/full", command), ExitCode::kOutput, {"standard output"});
  }
}

TEST(Output, ThatIsNotAskedForCannotFail) {
  const ScratchFolder scratch;
  const auto scene = TinyGltf().write(scratch.path());
  const Words run = run_arguments(scene, scratch / "run", {"image.width=8", "image.height=8"});
  EXPECT_EQ(run_sheaf_into("/dev/full", run).exit_code, 0);
}

TEST(Options, OfAStreamAreRefusedForATrace) {
  for (const char* option : {"--gap", "--writes", "--count", "--seed"}) {
    expect_refusal(run_sheaf({"memory", "trace.txt", option, "1"}), ExitCode::kUsage,
                   {option, "requires --generate"});
  }
}

TEST(Options, OfTheMemoryAloneAreAllThatItTakes) {
  const Words stream{"memory", "--generate", "random", "--count", "10"};
  for (const char* setting : {"l2.capacity=1MiB", "clock.frequency=2GHz", "film_cache.ways=2"}) {
    expect_refusal(run_sheaf(stream + Words{"--set", setting}), ExitCode::kUsage,
                   {setting, "dram."});
  }
  EXPECT_EQ(run_sheaf(stream + Words{"--set", "dram.page=closed"}).exit_code, 0);
  // A file may be of a whole machine.
  const ScratchFolder scratch;
  write_bytes(scratch / "machine.toml", "l2.capacity = \"1MiB\"\n");
  EXPECT_EQ(run_sheaf(stream + Words{"--config", (scratch / "machine.toml").string()}).exit_code,
            0);
}

TEST(Options, OfTheOtherKindOfTraceAreRefused) {
  const ScratchFolder scratch;
  const Words out{"--out", (scratch / "out").string()};
  const Words memory = Words{"replay", committed_trace("dragon-memory")} + out;
  const Words rays = Words{"replay", committed_trace("sponza-rays"), "--scene",
                           committed_scene("sponza").string()} +
                     out;
  expect_refusal(run_sheaf(memory + Words{"--scene", "nosuch"}), ExitCode::kUsage,
                 {"dragon-memory", "--scene", "rays"});
  for (const char* mode : {"fixed", "elastic"}) {
    expect_refusal(run_sheaf(rays + Words{"--mode", mode}), ExitCode::kUsage,
                   {"sponza-rays", "--mode", "memory"});
  }
  expect_refusal(run_sheaf(rays + Words{"--set", "image.heat_maps=rays"}), ExitCode::kUsage,
                 {"sponza-rays", "image.heat_maps", "sheaf run"});
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(Options, OfRunsInTimeAreRefusedWithoutTime) {
  const ScratchFolder scratch;
  for (const char* fidelity : {"functional", "analytic"}) {
    const Words run = run_arguments(committed_scene("sponza"), scratch / "out",
                                    {"run.max_cycles=1", std::string("run.fidelity=") + fidelity});
    expect_refusal(run_sheaf(run), ExitCode::kUsage, {"run.max_cycles", "run.fidelity"});
  }
}

TEST(Options, ThatNameAForeignProcessAreRefused) {
  const ScratchFolder scratch;
  const Words run = run_arguments(committed_scene("sponza"), scratch / "out", {});
  expect_refusal(run_sheaf(run + Words{"--parent", "1"}), ExitCode::kUsage, {"--parent 1"});
}

TEST(Refusals, NameTheWordAndTheNearestKnownOne) {
  const std::map<Words, Words> refused{
      {{"rnu"}, {"unknown command 'rnu'", "did you mean 'run'?"}},
      {{"simulate"}, {"unknown command 'simulate'", "`sheaf --help`"}},
      {{"trace", "exprot", "a.trace"}, {"unknown command 'exprot'", "'export'"}},
      {{"trace"}, {"a command is missing", "`sheaf trace --help`"}},
      {{}, {"a command is missing", "`sheaf --help`"}},
      {{"run", "a.glb", "--quite"}, {"unknown option '--quite'", "did you mean '--quiet'?"}},
      {{"run", "--quite"}, {"unknown option '--quite'", "did you mean '--quiet'?"}},
      {{"run", "a.glb", "--sets=l2.ways=4"}, {"unknown option '--sets'", "'--set'"}},
      {{"run", "a.glb", "--fast"}, {"unknown option '--fast'", "`sheaf run --help`"}},
      {{"run", "a.glb", "b.glb"}, {"'b.glb'", "too many", "`sheaf run --help`"}},
      {{"run"}, {"SCENE", "`sheaf run --help`"}},
      {{"run", "a.glb", "--record", "sound"}, {"--record", "sound", "rays"}},
      {{"memory", "--generate", "random", "--count", "many"}, {"--count", "many"}},
      {{"run", "a.glb", "--fa\nst"}, {"unknown option '--fa?st'"}}};
  for (const auto& [command, words] : refused) {
    SCOPED_TRACE(testing::PrintToString(command));
    expect_refusal(run_sheaf(command), ExitCode::kUsage, words);
  }
}

TEST(Refusals, AreOneLineWhateverTheNamesOfFilesAre) {
  const std::string odd = "/nowhere/a\nb";
  const std::string scene = committed_scene("sponza").string();
  expect_refusal(run_sheaf({"run", odd}), ExitCode::kScene, {"/nowhere/a?b"});
  expect_refusal(run_sheaf({"info", odd}), ExitCode::kScene, {"/nowhere/a?b"});
  expect_refusal(run_sheaf({"replay", odd}), ExitCode::kTrace, {"/nowhere/a?b"});
  expect_refusal(run_sheaf({"curve", odd}), ExitCode::kTrace, {"/nowhere/a?b"});
  expect_refusal(run_sheaf({"memory", odd}), ExitCode::kTrace, {"/nowhere/a?b"});
  expect_refusal(run_sheaf({"run", scene, "--out", "/proc/a\nb"}), ExitCode::kOutput,
                 {"/proc/a?b"});
}

TEST(Refusals, OfATextTraceHaveTheCodeOfTraces) {
  const ScratchFolder scratch;
  write_bytes(scratch / "bad.txt", "0x40 READ 1\n0x80 FETCH 2\n");
  expect_refusal(run_sheaf({"memory", (scratch / "bad.txt").string()}), ExitCode::kTrace,
                 {"bad.txt:2", "FETCH"});
  expect_refusal(run_sheaf({"memory", (scratch / "none.txt").string()}), ExitCode::kTrace,
                 {"none.txt"});
}

/// Help of every command, and of all of them together.
std::map<std::string, std::string> all_help() {
  std::map<std::string, std::string> help;
  for (const char* command :
       {"", "run", "memory", "accuracy", "replay", "trace", "trace info", "trace verify",
        "trace export", "curve", "stability", "info", "config", "counters", "coefficients"}) {
    Words words;
    std::istringstream stream(command);
    for (std::string word; stream >> word;) words.push_back(word);
    const CommandResult result = run_sheaf(words + Words{"--help"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    help[command] = result.out;
  }
  return help;
}

TEST(Help, FitsThePageAndNamesTypes) {
  constexpr std::size_t kWidth = 100;
  for (const auto& [command, text] : all_help()) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), kWidth) << command << ": " << line;
    }
    for (const char* raw : {"UINT", " INT", "FLOAT", "TEXT", " in [", "REQUIRED", "Needs:"}) {
      const bool free_text = command == "stability" && raw == std::string("TEXT");
      if (free_text) continue;
      EXPECT_EQ(text.find(raw), std::string::npos) << command << ": " << raw;
    }
  }
  const auto help = all_help();
  for (const char* shown : {"--config FILE", "--out DIR", "--cache DIR", "--parent N",
                            "--timeline-every N", "--record {rays,memory}"}) {
    EXPECT_NE(help.at("run").find(shown), std::string::npos) << shown;
  }
}

TEST(Help, ListsTheExitCodesThatCanOccur) {
  const auto codes = [](const std::string& text) {
    std::set<int> found;
    const std::size_t begin = text.find("Exit codes:");
    std::istringstream words(begin == std::string::npos ? "" : text.substr(begin));
    for (std::string word; words >> word;) {
      if (word.find_first_not_of("0123456789") == std::string::npos) found.insert(std::stoi(word));
    }
    return found;
  };
  const auto help = all_help();
  EXPECT_EQ(codes(help.at("")), (std::set<int>{0, 1, 2, 3, 4, 5, 6, 130}));
  for (const char* listing : {"config", "counters", "coefficients"}) {
    EXPECT_EQ(codes(help.at(listing)), (std::set<int>{0, 2, 4})) << listing;
  }
  EXPECT_EQ(codes(help.at("info")), (std::set<int>{0, 2, 3, 4}));
  EXPECT_EQ(codes(help.at("run")), (std::set<int>{0, 1, 2, 3, 4, 5, 130}));
  EXPECT_EQ(codes(help.at("memory")), (std::set<int>{0, 2, 4, 6}));
  EXPECT_EQ(codes(help.at("trace info")), (std::set<int>{0, 2, 4, 6}));
}

}  // namespace
}  // namespace sheaf::test
