// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <system_error>
#include <thread>
#include <vector>

namespace sheaf {

/// Threads that do `work` beside the calling one, `count` of them or as many as the system gives.
/// `work` must leave nothing undone if there are none, and must not throw. Joined when destroyed.
template <typename Work>
[[nodiscard]] std::vector<std::jthread> start_helpers(unsigned count, const Work& work) {
  std::vector<std::jthread> helpers;
  helpers.reserve(count);
  try {
    while (helpers.size() < count) helpers.emplace_back(work);
  } catch (const std::system_error&) {
    return helpers;  // fewer do the same
  }
  return helpers;
}

}  // namespace sheaf
