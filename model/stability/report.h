// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "stability/catalogue.h"

namespace sheaf::stability {

/// A case that has been run.
struct CaseResult {
  StabilityCase source;
  std::vector<Finding> findings;
  [[nodiscard]] bool passes() const;
};

/// One line a finding, aligned, for the terminal; what failed is told in full below.
[[nodiscard]] std::string as_text(const CaseResult& result);
/// The whole report: a table a group, then where each bound is from.
[[nodiscard]] std::string as_markdown(const std::vector<CaseResult>& results, const Effort& effort);
/// One line a finding: group, case, extreme, measured, trials, error, bound, verdict, why.
[[nodiscard]] std::string as_csv(const std::vector<CaseResult>& results);

}  // namespace sheaf::stability
