// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace sheaf {

/// A count of clock cycles of the modelled machine's core clock, or a point in time in such cycles.
using Cycles = std::uint64_t;
/// A number of bytes of simulated memory.
using Bytes = std::uint64_t;
/// A byte address in the simulated machine's physical address space.
using Address = std::uint64_t;

/// "Never": later than any cycle that a run can reach.
inline constexpr Cycles kNever = ~Cycles{0};

}  // namespace sheaf
