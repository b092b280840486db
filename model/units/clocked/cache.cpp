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

Cache::Result Cache::access(std::uint64_t line, DataKind kind, int waiter, bool dirty, Cycles now) {
  if (spec_.mode == CacheMode::kPerfect || array_.touch(line)) {
    count_access(kind, &CacheStats::num_hits);
    if (dirty && spec_.mode == CacheMode::kNormal) array_.mark_dirty(line);
    return Result::kHit;
  }
  const std::uint64_t bit = std::uint64_t{1} << waiter;
  const auto mshr =
      std::find_if(mshrs_.begin(), mshrs_.end(), [&](const Mshr& m) { return m.line == line; });
  if (mshr != mshrs_.end()) {
    count_access(kind, &CacheStats::num_merges);
    mshr->waiters |= bit;
    mshr->dirty |= dirty;
    return Result::kPending;
  }
  if (mshrs_.size() == spec_.mshrs) {
    ++stats_.num_mshr_stalls;
    waiting_for_mshr_ |= bit;
    return Result::kNoMshr;
  }
  count_access(kind, &CacheStats::num_misses);
  stats_.bytes_read += spec_.line;
  mshrs_.push_back({line, bit, now, kind, dirty});
  to_l2_.write({line * spec_.line, static_cast<std::uint32_t>(spec_.line), requester_, kind, false},
               now);
  return Result::kPending;
}

Cache::Arrival Cache::take_line(Cycles now) {
  const std::uint64_t line = line_of(from_l2_.read(now).address);
  const auto found =
      std::find_if(mshrs_.begin(), mshrs_.end(), [&](const Mshr& m) { return m.line == line; });
  const Mshr mshr = *found;
  mshrs_.erase(found);
  stats_.sum_miss_latency += now - mshr.since;
  stats_.mshr_occupancy_cycles += now - mshr.since;
  const CacheArray::Victim victim = array_.fill(line, mshr.dirty);
  if (victim.valid && victim.dirty) write_back(victim.line, mshr.kind, now);
  return {mshr.waiters, std::exchange(waiting_for_mshr_, 0)};
}

void Cache::write_back(std::uint64_t line, DataKind kind, Cycles now) {
  ++stats_.num_writebacks;
  stats_.bytes_written += spec_.line;
  to_l2_.write({line * spec_.line, static_cast<std::uint32_t>(spec_.line), requester_, kind, true},
               now);
}

std::vector<std::uint64_t> Cache::take_dirty_lines() {
  std::vector<std::uint64_t> lines;
  array_.clean_all([&](std::uint64_t line) { lines.push_back(line); });
  return lines;
}

}  // namespace sheaf::clocked
