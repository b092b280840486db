// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "base/units.h"
#include "stats/stall_account.h"

namespace sheaf::clocked {

/// Something that does its work cycle by cycle, and says what each cycle went to.
class Unit {
 public:
  explicit Unit(std::string name) : name_(std::move(name)) {}
  virtual ~Unit() = default;

  void tick(Cycles now) { stalls_.switch_to(act(now), now); }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  /// Does all that is done in cycle `now`; returns what the cycle went to.
  virtual StallCause act(Cycles now) = 0;

  const std::string name_;
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
