// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/own_process.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "apps/parent_death.h"
#include "base/errors.h"
#include "base/out_of_memory.h"

namespace sheaf {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

// Parent and child share an open file, through which the answer comes back: numbers, or the text of
// an error, whose code is the child's exit code.

template <typename Values>
bool write_all(std::FILE* file, const Values& values) {
  if (values.empty()) return true;  // an interrupted child has no numbers
  const bool whole =
      std::fwrite(values.data(), sizeof(values[0]), values.size(), file) == values.size();
  return std::fflush(file) == 0 && whole;
}

template <typename Values>
Values read_all(std::FILE* file) {
  Values values;
  std::rewind(file);
  typename Values::value_type value{};
  while (std::fread(&value, sizeof value, 1, file) == 1) values.push_back(value);
  return values;
}

ExitCode work_here(const std::function<std::vector<double>()>& work, std::FILE* answer) {
  const auto fail = [&](ExitCode code, const std::string& what) {
    write_all(answer, what);
    return code;
  };
  try {
    if (write_all(answer, work())) return ExitCode::kOk;
    return fail(ExitCode::kOutput, "a level's result could not be handed over; is the disk full?");
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kUsage, kOutOfMemory);
  } catch (const std::exception& error) {
    return fail(ExitCode::kBug,
                fmt::format("bug of the simulator, please report it: {}", error.what()));
  }
}

// A signal that ends this process alone must reach the other one too.
int wait_for(pid_t child, const std::function<bool()>& stop) {
  constexpr useconds_t kInterval = 10'000;
  bool told = false;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) throw Error(ExitCode::kBug, "lost a process");
    if (!told && stop()) {
      told = true;
      kill(child, SIGTERM);
    }
    usleep(kInterval);
  }
}

[[noreturn]] void refuse_signal(int signal) {
  constexpr std::array kCrashes{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
  const bool crashed = std::ranges::find(kCrashes, signal) != kCrashes.end();
  throw Error(crashed ? ExitCode::kBug : ExitCode::kUsage,
              fmt::format("a level was ended by signal {} ({}); {}", signal, strsignal(signal),
                          crashed ? "a bug of the simulator, please report it"
                                  : "if for want of memory, choose a smaller picture or scene"));
}

}  // namespace

std::vector<double> in_own_process(const std::function<std::vector<double>()>& work,
                                   const std::function<bool()>& stop) {
  const File answer(std::tmpfile(), std::fclose);
  if (answer == nullptr) throw Error(ExitCode::kOutput, "no temporary file could be made");
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw Error(ExitCode::kUsage, "no process could be started");
  if (child == 0) {
    const auto work_until_parent_ends = [&] {
      end_with_parent(parent);
      return work();
    };
    _exit(static_cast<int>(work_here(work_until_parent_ends, answer.get())));
  }
  const int status = wait_for(child, stop);
  if (!WIFEXITED(status)) refuse_signal(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) {
    throw Error(static_cast<ExitCode>(WEXITSTATUS(status)), read_all<std::string>(answer.get()));
  }
  return read_all<std::vector<double>>(answer.get());
}

}  // namespace sheaf
