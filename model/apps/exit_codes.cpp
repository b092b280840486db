// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/exit_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sheaf {

std::string exit_codes(std::initializer_list<ExitCode> codes) {
  using enum ExitCode;
  constexpr std::array<std::pair<ExitCode, const char*>, 8> kMeanings{
      {{kOk, "done"},
       {kBug, "bug of the simulator"},
       {kUsage, "command line or configuration refused"},
       {kScene, "scene refused"},
       {kOutput, "result not written"},
       {kStuck, "machine stuck"},
       {kTrace, "trace refused"},
       {kInterrupted, "interrupted (partial result, or none)"}}};
  constexpr std::array kCommon{kOk, kUsage, kOutput};
  std::string text;
  for (const auto& [code, meaning] : kMeanings) {
    const bool listed =
        std::ranges::find(kCommon, code) != kCommon.end() || std::ranges::count(codes, code) != 0;
    if (!listed) continue;
    text += fmt::format("{}{} {}", text.empty() ? "Exit codes: " : "; ", static_cast<int>(code),
                        meaning);
  }
  return text + ".";
}

}  // namespace sheaf
