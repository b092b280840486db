// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/units.h"

namespace sheaf {

/// Looks at a clock domain's agents between two cycles. No agent goes beyond a cycle that is to be
/// observed before it has been, so what is seen is the state of one time; between observed
/// stretches agents run ahead as ever. Nothing that agents do depends on being observed.
class CycleObserver {
 public:
  virtual ~CycleObserver() = default;

  /// The first cycle from `cycle` on that is to be observed; kNever: none.
  [[nodiscard]] virtual Cycles next_observed(Cycles cycle) = 0;

  /// All that is done up to and in `cycle` has been done, and nothing that is done later.
  virtual void observe(Cycles cycle) = 0;

  /// Whether SystemC's time shall be that of the cycle when it is observed.
  [[nodiscard]] virtual bool wants_kernel_time() const { return false; }
};

}  // namespace sheaf
