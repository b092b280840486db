// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace sheaf::stability {

/// What a job may take before it is ended by a signal.
struct ChildLimits {
  unsigned cpu_seconds = 0;   ///< of processor time; ten times as much under a sanitizer
  unsigned wall_seconds = 0;  ///< of any time: for a job that waits for what never comes
  /// Of addresses; without effect under a sanitizer, which takes more than there is.
  std::uint64_t address_bytes = std::numeric_limits<std::uint64_t>::max();
};

/// Runs `job` in a process of its own, since SystemC keeps one simulation a process, and returns
/// what it returned. Whatever ends the process otherwise is told instead: "ended by signal 11".
/// A signal that asks this process to stop ends the job too: throws Error(kInterrupted).
[[nodiscard]] std::string run_in_child(const std::function<std::string()>& job,
                                       const ChildLimits& limits);

}  // namespace sheaf::stability
