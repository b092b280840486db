// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/errors.h"
#include "base/interrupt.h"

namespace sheaf::stability {
namespace {

constexpr ChildLimits kAmple{.cpu_seconds = 60, .wall_seconds = 600};

TEST(ChildProcess, GivesTheAnswerOfItsJob) {
  const std::string long_answer(100'000, 'x');
  EXPECT_EQ(run_in_child([&] { return long_answer; }, kAmple), long_answer);
}

TEST(ChildProcess, TellsWhatEndedIt) {
  const auto fall = []() -> std::string {
    std::raise(SIGKILL);
    return "not reached";
  };
  EXPECT_EQ(run_in_child(fall, kAmple), "ended by signal 9");
}

TEST(ChildProcess, ThatWaitsForNothingIsEnded) {
  const auto wait = []() -> std::string {
    for (;;) pause();
  };
  EXPECT_EQ(run_in_child(wait, {.cpu_seconds = 60, .wall_seconds = 1}), "ended by signal 14");
}

TEST(ChildProcess, ThatNeverStopsComputingIsEnded) {
  const auto compute = []() -> std::string {
    for (volatile unsigned i = 0;;) i = i + 1;
  };
  EXPECT_EQ(run_in_child(compute, {.cpu_seconds = 1, .wall_seconds = 600}), "ended by signal 9");
}

TEST(ChildProcess, IsEndedIfThisProcessIsAskedToStop) {
  catch_interrupts();
  const auto ask = []() -> std::string {
    kill(getppid(), SIGTERM);
    for (;;) pause();
  };
  try {
    (void)run_in_child(ask, {.cpu_seconds = 60, .wall_seconds = 3000});
    ADD_FAILURE() << "ended by itself";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInterrupted);
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "the job is still there";
}

}  // namespace
}  // namespace sheaf::stability
