// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace sheaf {

/// Exit codes of the sheaf command; `sheaf --help` prints this list.
enum class ExitCode : int {
  kOk = 0,
  kBug = 1,           ///< a conservation check failed: a bug of the simulator
  kUsage = 2,         ///< command line or configuration refused
  kScene = 3,         ///< scene file refused
  kOutput = 4,        ///< a result could not be written
  kStuck = 5,         ///< the configured machine can make no progress
  kTrace = 6,         ///< trace file refused
  kInterrupted = 130  ///< stopped by the user; partial results are marked as such
};

/// An error that the user can mend. `what()` is one line: the place, what is wrong, the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace sheaf
