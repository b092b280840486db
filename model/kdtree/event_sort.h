// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "kdtree/split_event.h"

namespace sheaf {

/// Sorts events by coordinate and kind in linear time, keeping the order of equal ones; scratch
/// must hold as many events.
void sort_events(std::span<SplitEvent> events, std::span<SplitEvent> scratch);

}  // namespace sheaf
