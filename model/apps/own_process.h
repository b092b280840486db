// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace sheaf {

/// Does `work` in a process of its own, which is forked from this one and shares what it has made
/// so far, and returns the numbers that it gives: SystemC keeps one simulation a process. An Error
/// that it throws is thrown here. Ended by a signal, it is an Error too: kBug if it crashed, else
/// kUsage, since the system ends so what takes too much memory. The process ends with this one,
/// and is sent SIGTERM once `stop`, which is asked now and then, says so.
[[nodiscard]] std::vector<double> in_own_process(const std::function<std::vector<double>()>& work,
                                                 const std::function<bool()>& stop);

}  // namespace sheaf
