// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "stability/catalogue.h"

namespace sheaf::stability {

/// Pixels between two mirrors of reflectance 0.999, 100 reflections deep, against the geometric
/// series that they are, in every format of the film.
[[nodiscard]] std::vector<Finding> two_mirrors();

}  // namespace sheaf::stability
