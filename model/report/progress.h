// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace sheaf {

/// " 42 %  tiles 500 of 1200  1:03 left", cut to `columns` characters. `fraction` is clamped to
/// [0, 1]; the time left is `elapsed` scaled by what remains, and unknown at fraction 0.
[[nodiscard]] std::string progress_line(double fraction, std::string_view text,
                                        std::chrono::duration<double> elapsed, std::size_t columns);

/// One line on standard error that tells how far a run is. Shown only on a terminal and after a
/// quiet time, so that logs and short runs stay clean; erased at the end.
class Progress {
 public:
  explicit Progress(std::chrono::milliseconds quiet_time = std::chrono::seconds(2),
                    std::chrono::milliseconds redraw_time = kRedrawTime);
  ~Progress() { erase(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap: redraws once in `redraw_time` at most.
  void update(double fraction, std::string_view text);

  /// Removes the line, so that something else can be printed.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kRedrawTime{200};

  const std::chrono::milliseconds redraw_time_;

  bool on_terminal_;
  bool drawn_ = false;
  Clock::time_point start_, next_;
};

}  // namespace sheaf
