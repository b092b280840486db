// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sheaf {
namespace {

std::size_t terminal_columns() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsual;
}

std::string time_left(double fraction, double elapsed) {
  constexpr double kDay = 86400;
  const double left = elapsed * (1 - fraction) / fraction;
  if (!(left < kDay)) return "over a day left";
  const auto seconds = static_cast<unsigned>(left + 0.5);
  if (seconds < 3600) return fmt::format("{}:{:02} left", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02} left", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace

std::string progress_line(double fraction, std::string_view text,
                          std::chrono::duration<double> elapsed, std::size_t columns) {
  const double done = fraction > 0 ? std::min(fraction, 1.0) : 0.0;
  std::string line = fmt::format("{:3} %  {}", static_cast<int>(done * 100), text);
  if (done > 0) line += "  " + time_left(done, elapsed.count());
  line.resize(std::min(line.size(), columns));
  return line;
}

Progress::Progress(std::chrono::milliseconds quiet_time, std::chrono::milliseconds redraw_time)
    : redraw_time_(redraw_time),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + quiet_time) {}

void Progress::update(double fraction, std::string_view text) {
  if (!on_terminal_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + redraw_time_;
  drawn_ = true;
  // The last column stays free: some terminals wrap when it is written.
  fmt::print(stderr, "\r\033[K{}",
             progress_line(fraction, text, now - start_, terminal_columns() - 1));
  std::fflush(stderr);
}

void Progress::erase() {
  if (!drawn_) return;
  drawn_ = false;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace sheaf
