// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace CLI {
class App;
}

namespace sheaf {

struct CurveOptions {
  std::filesystem::path trace;
  std::vector<std::uint64_t> lines{64};
  std::vector<std::uint64_t> sets{1};
  std::filesystem::path out = "result/curve";
  bool quiet = false;
};

/// Declares `sheaf curve`, bound to `options`.
void declare_curve_command(CLI::App& app, CurveOptions& options);

/// `sheaf curve`: LRU miss ratios of all cache sizes from a memory trace. Returns an exit code;
/// throws Error for what the user can mend.
int curve_command(const CurveOptions& options);

}  // namespace sheaf
