// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/units.h"

namespace sheaf {

enum class DramCommand : std::uint8_t {
  kActivate,
  kPrecharge,
  kPrechargeAll,
  kRead,
  kWrite,
  kReadPrecharge,  ///< with auto-precharge
  kWritePrecharge,
  kRefresh
};

/// A command as it goes over a channel's command bus, for whoever watches.
struct IssuedCommand {
  Cycles at = 0;  ///< tCK
  DramCommand command{};
  std::uint32_t rank = 0;
  std::uint32_t bank_group = 0;
  std::uint32_t bank = 0;  ///< in its group
  std::uint32_t row = 0;
};

}  // namespace sheaf
