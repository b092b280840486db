// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <system_error>
#include <thread>
#include <vector>

namespace sheaf {

/// Threads that each do `work`, which must not throw: as many as asked for, or fewer if memory or
/// the system has no room for more. Whoever asks does the same work beside them, so it gets done
/// even by none.
template <typename Work>
[[nodiscard]] std::vector<std::jthread> start_helpers(unsigned most, const Work& work) {
  std::vector<std::jthread> helpers;
  helpers.reserve(most);
  try {
    while (helpers.size() < most) helpers.emplace_back(work);
  } catch (const std::system_error&) {
  }
  return helpers;
}

}  // namespace sheaf
