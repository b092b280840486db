// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/cache.h"

#include <algorithm>
#include <utility>

namespace sheaf::clocked {

Cache::Cache(const CacheSpec& spec, std::uint16_t requester, Link<LineRequest>& to_l2,
             Link<LineResponse>& from_l2)
    : spec_(spec),
      requester_(requester),
      to_l2_(to_l2),
      from_l2_(from_l2),
      array_(bank_shape(spec, 1)) {}

void Cache::count_access(DataKind kind, std::uint64_t CacheStats::*outcome) {
  CacheKindStats& of_kind = kind_stats_[static_cast<std::size_t>(kind)];
  ++stats_.num_accesses;
  ++of_kind.num_accesses;
  ++(stats_.*outcome);
  if (outcome == &CacheStats::num_hits) ++of_kind.num_hits;
}

Cache::Result Cache::read(std::uint64_t line, DataKind kind, int waiter, Cycles now) {
  if (spec_.mode != CacheMode::kPerfect && !array_.touch(line)) {
    return miss(line, kind, waiter, false, now);
  }
  count_access(kind, &CacheStats::num_hits);
  return Result::kHit;
}

Cache::Result Cache::modify(Address address, Bytes bytes, DataKind kind, int waiter, Cycles now) {
  const std::uint64_t line = line_of(address);
  const bool perfect = spec_.mode == CacheMode::kPerfect;
  if (!perfect && !can_write()) return wait_for_room(stats_.num_write_stalls, waiter);
  if (!perfect && !array_.touch(line)) return miss(line, kind, waiter, true, now);
  count_access(kind, &CacheStats::num_hits);
  if (perfect) return Result::kHit;
  if (spec_.write.policy == WritePolicy::kBack) {
    array_.mark_dirty(line);
  } else {
    ++stats_.num_writes_through;
    send_write(address, bytes, kind, now);
  }
  return Result::kHit;
}

Cache::Result Cache::miss(std::uint64_t line, DataKind kind, int waiter, bool dirty, Cycles now) {
  const std::uint64_t bit = std::uint64_t{1} << waiter;
  const auto mshr =
      std::find_if(mshrs_.begin(), mshrs_.end(), [&](const Mshr& m) { return m.line == line; });
  if (mshr != mshrs_.end()) {
    const bool full = spec_.mshr_targets != 0 && mshr->targets == spec_.mshr_targets;
    if (full) return wait_for_room(stats_.num_target_stalls, waiter);
    count_access(kind, &CacheStats::num_merges);
    ++mshr->targets;
    mshr->waiters |= bit;
    mshr->dirty |= dirty;
    return Result::kPending;
  }
  if (mshrs_.size() == spec_.mshrs) return wait_for_room(stats_.num_mshr_stalls, waiter);
  count_access(kind, &CacheStats::num_misses);
  stats_.bytes_read += line_size();
  mshrs_.push_back({line, bit, 1, now, kind, dirty});
  to_l2_.write({line * line_size(), static_cast<std::uint32_t>(line_size()), requester_, kind},
               now);
  return Result::kPending;
}

Cache::Result Cache::wait_for_room(std::uint64_t& counter, int waiter) {
  ++counter;
  waiting_for_room_ |= std::uint64_t{1} << waiter;
  return Result::kNoRoom;
}

Cycles Cache::port_cycles(std::span<const std::uint64_t> lines) const {
  std::vector<Cycles> lookups(spec_.banks, 0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::uint64_t tag = lines[i] / spec_.sectors;
    if (i == 0 || tag != lines[i - 1] / spec_.sectors) ++lookups[tag % spec_.banks];
  }
  const Cycles most = *std::max_element(lookups.begin(), lookups.end());
  return (most + spec_.ports - 1) / spec_.ports;
}

Cache::Arrival Cache::take_response(Cycles now) {
  const LineResponse response = from_l2_.read(now);
  const std::uint64_t of_room = std::exchange(waiting_for_room_, 0);
  if (response.of_write()) {
    --writes_out_;
    return {0, of_room};
  }
  const std::uint64_t line = line_of(response.address);
  const auto found =
      std::find_if(mshrs_.begin(), mshrs_.end(), [&](const Mshr& m) { return m.line == line; });
  const Mshr mshr = *found;
  mshrs_.erase(found);
  stats_.sum_miss_latency += now - mshr.since;
  stats_.mshr_occupancy_cycles += now - mshr.since;
  fill(mshr, now);
  return {mshr.waiters, of_room};
}

// A line that was written while it was on its way is dirty, or passed on at once.
void Cache::fill(const Mshr& mshr, Cycles now) {
  const bool through = spec_.write.policy == WritePolicy::kThrough;
  if (mshr.dirty && through) {
    ++stats_.num_writes_through;
    send_write(mshr.line * line_size(), line_size(), mshr.kind, now);
  } else if (mshr.dirty && !spec_.write.allocate) {
    write_back(mshr.line, mshr.kind, now);
  }
  if (!spec_.write.allocate) return;
  const CacheArray::Victim victim = array_.fill(mshr.line, mshr.dirty && !through);
  for (std::uint32_t sector = 0; sector < spec_.sectors; ++sector) {
    if ((victim.dirty >> sector & 1U) != 0) write_back(victim.line + sector, mshr.kind, now);
  }
}

void Cache::write_back(std::uint64_t line, DataKind kind, Cycles now) {
  ++stats_.num_writebacks;
  send_write(line * line_size(), line_size(), kind, now);
}

void Cache::send_write(Address address, Bytes bytes, DataKind kind, Cycles now) {
  const bool bounded = spec_.write.buffer != 0;
  if (bounded) ++writes_out_;
  stats_.bytes_written += bytes;
  to_l2_.write({address, static_cast<std::uint32_t>(bytes), requester_, kind, true, bounded}, now);
}

std::vector<std::uint64_t> Cache::take_dirty_lines() {
  std::vector<std::uint64_t> lines;
  array_.clean_all([&](std::uint64_t line) { lines.push_back(line); });
  return lines;
}

}  // namespace sheaf::clocked
