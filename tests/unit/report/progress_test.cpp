// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <string>

namespace sheaf {
namespace {

using std::chrono::seconds;

TEST(Progress, LineTellsShareTextAndTimeLeft) {
  EXPECT_EQ(progress_line(0.5, "tiles", seconds(63), 80), " 50 %  tiles  1:03 left");
  EXPECT_EQ(progress_line(0.25, "tiles", seconds(3600), 80), " 25 %  tiles  3:00:00 left");
  EXPECT_EQ(progress_line(1.0, "tiles", seconds(5), 80), "100 %  tiles  0:00 left");
}

TEST(Progress, NothingDoneTellsNoTimeLeft) {
  EXPECT_EQ(progress_line(0.0, "tiles", seconds(5), 80), "  0 %  tiles");
}

TEST(Progress, FractionsOutOfRangeAreClamped) {
  EXPECT_EQ(progress_line(7.0, "x", seconds(5), 80), "100 %  x  0:00 left");
  EXPECT_EQ(progress_line(-1.0, "x", seconds(5), 80), "  0 %  x");
  EXPECT_EQ(progress_line(std::numeric_limits<double>::quiet_NaN(), "x", seconds(5), 80),
            "  0 %  x");
  EXPECT_EQ(progress_line(1e-300, "x", seconds(5), 80), "  0 %  x  over a day left");
}

TEST(Progress, LineIsCutToTheTerminal) {
  EXPECT_EQ(progress_line(0.5, "tiles", seconds(63), 10), " 50 %  til");
}

TEST(Progress, ALogStaysClean) {
  testing::internal::CaptureStderr();
  {
    Progress progress(seconds(0), seconds(3600));
    progress.update(0.5, "tiles");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

constexpr int kSettledMilliseconds = 200;

/// What `run` writes to standard error while that is a terminal.
template <typename Run>
std::string written_to_terminal(Run run) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  EXPECT_TRUE(terminal >= 0 && grantpt(terminal) == 0 && unlockpt(terminal) == 0);
  const int inside = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  const int usual_stderr = dup(STDERR_FILENO);
  dup2(inside, STDERR_FILENO);
  run();
  dup2(usual_stderr, STDERR_FILENO);
  tcdrain(inside);
  std::string written;
  std::array<char, 1000> buffer{};
  pollfd readable{terminal, POLLIN, 0};
  // A terminal hands on what was written in parts, and some time later.
  while (poll(&readable, 1, kSettledMilliseconds) > 0 && (readable.revents & POLLIN) != 0) {
    const auto length = read(terminal, buffer.data(), buffer.size());
    if (length <= 0) break;
    written.append(buffer.data(), static_cast<std::size_t>(length));
  }
  for (const int file : {terminal, inside, usual_stderr}) close(file);
  return written;
}

TEST(Progress, ATerminalShowsTheLineAndLosesItAtTheEnd) {
  const std::string written = written_to_terminal([] {
    Progress progress(seconds(0), seconds(3600));
    progress.update(0.0, "tiles");
    progress.update(0.1, "too soon after the first");
  });
  EXPECT_EQ(written, "\r\033[K  0 %  tiles\r\033[K");
}

TEST(Progress, AShortRunShowsNothing) {
  EXPECT_EQ(written_to_terminal([] { Progress().update(0.5, "tiles"); }), "");
}

}  // namespace
}  // namespace sheaf
