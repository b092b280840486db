// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/stream.h"

#include <algorithm>

namespace sheaf {

AccessStream::AccessStream(const StreamSpec& spec, const DramDevice& device)
    : spec_(spec),
      organization_(device.organization),
      map_(device.map),
      num_places_(device.organization.capacity() / spec.bytes),
      random_(spec.seed),
      writes_(mix64(spec.seed)) {}

bool AccessStream::next(TraceAccess& access) {
  if (index_ == spec_.count) return false;
  access.arrival = index_ * spec_.gap;
  access.write = spec_.write_share > 0 && writes_.uniform() < spec_.write_share;
  switch (spec_.kind) {
    case StreamKind::kSequential:
      access.address = index_ % num_places_ * spec_.bytes;
      break;
    case StreamKind::kRandom:
      access.address = random_.below(num_places_) * spec_.bytes;
      break;
    default:
      access.address = interleaved(index_ % num_places_);
  }
  ++index_;
  return true;
}

Address AccessStream::interleaved(std::uint64_t index) const {
  const auto take = [&index](std::uint32_t count) {
    const auto part = static_cast<std::uint32_t>(index % count);
    index /= count;
    return part;
  };
  const auto bursts =
      static_cast<std::uint32_t>(std::max<Bytes>(1, spec_.bytes / organization_.burst_bytes));
  DramLocation where;
  where.channel = take(organization_.channels);
  where.bank_group = take(organization_.bank_groups);
  where.column = take(std::max(1U, organization_.columns / bursts)) * bursts;
  where.bank = take(organization_.banks);
  where.rank = take(organization_.ranks);
  where.row = take(organization_.rows);
  return map_.address_of(where);
}

}  // namespace sheaf
