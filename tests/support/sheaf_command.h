// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/errors.h"

namespace sheaf::test {

struct CommandResult {
  int exit_code = -1;            ///< 128 + n if signal n ended it
  std::string out;               ///< standard output
  std::string err;               ///< standard error
  std::uint64_t peak_bytes = 0;  ///< most resident memory; at least this process's own
};

/// Runs the sheaf command that was built with this test and waits for its end. `meanwhile` is
/// called with its process number once it has been started.
[[nodiscard]] CommandResult run_sheaf(const std::vector<std::string>& arguments,
                                      const std::function<void(pid_t)>& meanwhile = {});

/// The same with standard output going to `out`, which is not read: the result's `out` is empty.
[[nodiscard]] CommandResult run_sheaf_into(const std::filesystem::path& out,
                                           const std::vector<std::string>& arguments);

/// Expects a refusal with this exit code: one line that begins with "sheaf: " and holds all words,
/// on standard error alone.
void expect_refusal(const CommandResult& result, ExitCode code,
                    const std::vector<std::string>& words);

/// Arguments of `sheaf run --quiet`; every setting is a key=value.
[[nodiscard]] std::vector<std::string> run_arguments(const std::filesystem::path& scene,
                                                     const std::filesystem::path& out,
                                                     const std::vector<std::string>& settings);

/// The stats.json of a result folder; throws if it is not there or no JSON.
[[nodiscard]] nlohmann::json read_stats(const std::filesystem::path& folder);

}  // namespace sheaf::test
