// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace sheaf::stability {

/// Runs `job` in a process of its own, since SystemC keeps one simulation a process, and returns
/// what it returned. Whatever ends the process otherwise is told instead: "ended by signal 11".
/// A job that takes more than so many seconds of processor time is ended so, and a signal that asks
/// this process to stop ends it at once if it is sent to both.
[[nodiscard]] std::string run_in_child(const std::function<std::string()>& job, unsigned seconds);

}  // namespace sheaf::stability
