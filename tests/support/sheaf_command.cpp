// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/sheaf_command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "support/scratch_folder.h"

namespace sheaf::test {
namespace {

constexpr int kCannotStart = 127;

[[noreturn]] void become_sheaf(std::vector<std::string> arguments, const std::string& out,
                               const std::string& err) {
  std::string command = SHEAF_COMMAND;
  std::vector<char*> argv{command.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const int out_file = open(out.c_str(), O_CREAT | O_WRONLY, 0600);
  const int err_file = open(err.c_str(), O_CREAT | O_WRONLY, 0600);
  if (dup2(out_file, STDOUT_FILENO) >= 0 && dup2(err_file, STDERR_FILENO) >= 0) {
    execv(command.c_str(), argv.data());
  }
  _exit(kCannotStart);
}

/// Everything but standard output.
CommandResult wait_for_sheaf(const std::vector<std::string>& arguments, const std::string& out,
                             const std::function<void(pid_t)>& meanwhile) {
  const ScratchFolder scratch;
  const std::string err = scratch / "err";
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) become_sheaf(arguments, out, err);
  if (meanwhile) meanwhile(child);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) throw std::runtime_error("lost a process");
  }
  CommandResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (result.exit_code == kCannotStart) throw std::runtime_error("cannot run " SHEAF_COMMAND);
  result.err = read_bytes(err);
  result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return result;
}

}  // namespace

CommandResult run_sheaf(const std::vector<std::string>& arguments,
                        const std::function<void(pid_t)>& meanwhile) {
  const ScratchFolder scratch;
  const std::string out = scratch / "out";
  CommandResult result = wait_for_sheaf(arguments, out, meanwhile);
  result.out = read_bytes(out);
  return result;
}

CommandResult run_sheaf_into(const std::filesystem::path& out,
                             const std::vector<std::string>& arguments) {
  return wait_for_sheaf(arguments, out, {});
}

void expect_refusal(const CommandResult& result, ExitCode code,
                    const std::vector<std::string>& words) {
  EXPECT_EQ(result.exit_code, static_cast<int>(code)) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("sheaf: ")) << result.err;
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " is not in: " << result.err;
  }
}

std::vector<std::string> run_arguments(const std::filesystem::path& scene,
                                       const std::filesystem::path& out,
                                       const std::vector<std::string>& settings) {
  std::vector<std::string> arguments{"run", scene.string(), "--out", out.string(), "--quiet"};
  for (const std::string& setting : settings) {
    arguments.emplace_back("--set");
    arguments.push_back(setting);
  }
  return arguments;
}

nlohmann::json read_stats(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_bytes(folder / "stats.json"));
}

}  // namespace sheaf::test
