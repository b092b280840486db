// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stats/report_tree.h"
#include "stats/sample_estimate.h"
#include "system/observation.h"

namespace sheaf {

/// A quantity out of the report of any fidelity: the estimate where one is stated, with its
/// interval, else the sums of the units' counters. What is not there is NaN.
[[nodiscard]] Estimate observed(const StatsTree& stats, const Quantity& quantity);

}  // namespace sheaf
