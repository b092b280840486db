// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/random.h"
#include "config/dram/device.h"
#include "memory/dram/text_trace.h"

namespace sheaf {

enum class StreamKind : std::uint8_t { kSequential, kRandom, kInterleaved };

/// A stream of accesses made up instead of read.
struct StreamSpec {
  StreamKind kind{};
  std::uint64_t count = 0;
  Cycles gap = 0;          ///< tCK between two arrivals
  std::uint64_t seed = 1;  ///< of random addresses and of which accesses write
  double write_share = 0;  ///< of all accesses
  Bytes bytes = 64;        ///< of an access; addresses are multiples of it
};

/// Sequential: one access after the other from address 0 on. Random: uniform over the capacity.
/// Interleaved: neighbouring accesses in different bank groups and the same row of each, the bank
/// group changing first, then the column, the bank, the rank and the row; channels take turns.
class AccessStream {
 public:
  AccessStream(const StreamSpec& spec, const DramDevice& device);

  bool next(TraceAccess& access);

 private:
  [[nodiscard]] Address interleaved(std::uint64_t index) const;

  const StreamSpec spec_;
  const DramOrganization organization_;
  const AddressMap map_;
  const std::uint64_t num_places_;  ///< accesses that the memory holds
  Random random_;
  Random writes_;
  std::uint64_t index_ = 0;
};

}  // namespace sheaf
