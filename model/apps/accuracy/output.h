// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "apps/accuracy/image_error.h"
#include "apps/accuracy/levels.h"
#include "apps/accuracy/precision.h"
#include "report/plot.h"

namespace sheaf {

/// What `sheaf accuracy` found out.
struct AccuracyResult {
  std::string scene;
  std::vector<LevelRun> runs;
  LevelRun reference;
  std::vector<ImageError> images;
  PrecisionCosts precision;
};

// For people.
[[nodiscard]] std::string accuracy_text(const AccuracyResult& result);

// One row a level; every quantity with its error, and the half width of its interval where it has
// one. Only the times differ from run to run.
[[nodiscard]] std::string accuracy_csv(const AccuracyResult& result);
[[nodiscard]] std::string image_error_csv(const AccuracyResult& result);

// Error over processor time, and relMSE over cycles.
[[nodiscard]] Plot accuracy_plot(const AccuracyResult& result);
[[nodiscard]] Plot image_error_plot(const AccuracyResult& result);

}  // namespace sheaf
