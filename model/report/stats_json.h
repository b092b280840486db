// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "stats/report_tree.h"

namespace sheaf {

/// The report as a JSON object of dotted names, in the tree's order, one entry a line:
///     "system.ray_cache.num_hits": {"value": 12, "unit": "rays"},
/// Counts are exact integers, reals the shortest text that reads back exactly, a missing value is
/// null. The same tree gives the same bytes.
[[nodiscard]] std::string stats_json(const StatsTree& tree);

}  // namespace sheaf
