// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/data_kind.h"
#include "base/units.h"

namespace sheaf {

/// From a private cache to the L2: fetch a line, or write some of one.
struct LineRequest {
  Address address = 0;  ///< of the first byte
  std::uint32_t bytes = 0;
  std::uint16_t requester = 0;
  DataKind kind{};
  bool write : 1 = false;
  bool acknowledged : 1 = false;  ///< a write that is to be answered
};

/// From the L2 to a private cache: the line that was asked for, or that a write was taken.
struct LineResponse {
  static constexpr Address kWriteTaken = ~Address{0};
  Address address = 0;
  [[nodiscard]] bool of_write() const { return address == kWriteTaken; }
};

}  // namespace sheaf
