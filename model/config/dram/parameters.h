// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/dram/settings.h"
#include "config/parameters.h"

namespace sheaf {

/// Declares dram.*.
void declare_dram(ParameterTable& table, DramSpec& dram);

}  // namespace sheaf
