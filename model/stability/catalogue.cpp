// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/catalogue.h"

#include <algorithm>
#include <iterator>

namespace sheaf::stability {

std::vector<StabilityCase> catalogue() {
  std::vector<StabilityCase> all;
  for (const auto& group : {ray_cases, leak_cases, secondary_cases, light_cases, sum_cases,
                            machine_cases, input_cases, precision_cases}) {
    std::ranges::move(group(), std::back_inserter(all));
  }
  return all;
}

}  // namespace sheaf::stability
