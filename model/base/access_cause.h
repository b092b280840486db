// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/units.h"

namespace sheaf {

/// Why some work began when it did, for who records a memory trace: a step of a unit that it had to
/// wait for, or that nothing else was going on any more. Travels with packets and bundles.
struct AccessCause {
  static constexpr std::uint16_t kAllEarlier = 0xFFFF;

  std::uint64_t record = 0;  ///< number of the step's last record in its stream
  Cycles done = 0;           ///< when the step was done, or everything was
  Cycles sent = 0;           ///< when the work could have set out if nothing had been in its way
  std::uint16_t stream = kAllEarlier;
  bool ended = false;  ///< not the step alone, but with it the chain that it ends
};

}  // namespace sheaf
