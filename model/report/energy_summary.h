// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "stats/report_tree.h"

namespace sheaf {

/// The summary's sections on energy and area, and on what the ray cache costs and spares. Empty if
/// the report has no energy.
[[nodiscard]] std::string summarize_energy(const StatsTree& stats);

}  // namespace sheaf
