// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/child_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "base/errors.h"
#include "base/interrupt.h"

namespace sheaf::stability {
namespace {

// Sanitizers make a job slower by so much, and take more addresses than there are.
#ifdef SHEAF_SANITIZED
constexpr unsigned kSlowdown = 10;
constexpr bool kHasAddressLimit = false;
#else
constexpr unsigned kSlowdown = 1;
constexpr bool kHasAddressLimit = true;
#endif

void write_all(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count <= 0) return;
    done += static_cast<std::size_t>(count);
  }
}

/// False if this process has been asked to stop before anything came.
bool wait_for_input(int file) {
  constexpr int kMilliseconds = 100;
  pollfd input{file, POLLIN, 0};
  while (!interrupted()) {
    if (poll(&input, 1, kMilliseconds) > 0) return true;
  }
  return false;
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  while (wait_for_input(file)) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

void limit(decltype(RLIMIT_CPU) resource, std::uint64_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

void apply(const ChildLimits& limits) {
  std::signal(SIGALRM, SIG_DFL);
  alarm(limits.wall_seconds);
  limit(RLIMIT_CPU, std::uint64_t{kSlowdown} * limits.cpu_seconds);
  if (kHasAddressLimit) limit(RLIMIT_AS, limits.address_bytes);
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& job, const ChildLimits& limits) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe to another process");
  std::fflush(nullptr);  // or the child would print again what waits to be printed
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
    apply(limits);
    write_all(ends[1], job());
    _exit(0);
  }
  close(ends[1]);
  std::string answer = read_all(ends[0]);
  close(ends[0]);
  if (interrupted()) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (interrupted()) {
    throw Error(ExitCode::kInterrupted, "stopped while a job was running; nothing is written");
  }
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
  return answer;
}

}  // namespace sheaf::stability
