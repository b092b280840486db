// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/private_cache.h"

#include <bit>

namespace sheaf {

PrivateCache::PrivateCache(const CacheSpec& spec, TimedOut<LineRequest>& requests,
                           std::uint16_t requester)
    : spec_(spec),
      line_shift_(static_cast<unsigned>(std::countr_zero(spec.line / spec.sectors))),
      sector_shift_(static_cast<unsigned>(std::countr_zero(spec.sectors))),
      lookups_per_cycle_(std::uint64_t{spec.banks} * spec.ports),
      is_plain_(lookups_per_cycle_ == 1 && spec.sectors == 1),
      most_targets_(spec.mshr_targets != 0 ? spec.mshr_targets : ~std::uint32_t{0}),
      array_(bank_shape(spec, 1)),
      mshrs_(spec.mshrs),
      requests_(requests),
      requester_(requester) {}

PrivateCache::Result PrivateCache::modify(Address address, Bytes bytes, DataKind kind, int waiter,
                                          Cycles now) {
  const std::uint64_t line = line_of(address);
  written_kind_ = kind;
  if (spec_.mode == CacheMode::kPerfect) {
    count_hit(kind);
    return Result::kHit;
  }
  if (!can_write()) return wait_for_room(stats_.num_write_stalls, waiter);
  if (!array_.touch(line)) return miss(line, kind, waiter, true, now);
  count_hit(kind);
  if (spec_.write.policy == WritePolicy::kBack) {
    array_.mark_dirty(line);
  } else {
    ++stats_.num_writes_through;
    send_write(address, bytes, now);
  }
  return Result::kHit;
}

PrivateCache::Result PrivateCache::miss(std::uint64_t line, DataKind kind, int waiter, bool dirty,
                                        Cycles now) {
  const std::uint64_t bit = std::uint64_t{1} << waiter;
  for (std::uint32_t i = 0; i < num_mshrs_used_; ++i) {
    Mshr& mshr = mshrs_[i];
    if (mshr.line != line) continue;
    if (mshr.targets == most_targets_) return wait_for_room(stats_.num_target_stalls, waiter);
    ++mshr.targets;
    mshr.waiters |= bit;
    mshr.dirty |= dirty;
    count_access(kind);
    ++stats_.num_merges;
    return Result::kPending;
  }
  if (num_mshrs_used_ == mshrs_.size()) return wait_for_room(stats_.num_mshr_stalls, waiter);
  count_occupancy(now);
  mshrs_[num_mshrs_used_++] = {line, bit, now, 1, dirty};
  count_access(kind);
  ++stats_.num_misses;
  stats_.bytes_read += line_size();
  requests_.write_ahead({line << line_shift_, static_cast<std::uint32_t>(line_size()), requester_,
                         kind, false, false},
                        now, requester_);
  return Result::kPending;
}

PrivateCache::Result PrivateCache::wait_for_room(std::uint64_t& counter, int waiter) {
  ++counter;
  waiting_for_room_ |= std::uint64_t{1} << waiter;
  return Result::kNoMshr;
}

void PrivateCache::count_occupancy(Cycles now) {
  stats_.mshr_occupancy_cycles += num_mshrs_used_ * (now - counted_until_);
  counted_until_ = now;
}

std::uint64_t PrivateCache::fill(const LineResponse& response, Cycles now, std::uint64_t& retry) {
  retry |= waiting_for_room_;
  waiting_for_room_ = 0;
  if (response.of_write()) {
    --num_writes_out_;
    return 0;
  }
  const std::uint64_t line = line_of(response.address);
  std::uint32_t i = 0;
  while (mshrs_[i].line != line) ++i;
  count_occupancy(now);
  const Mshr filled = mshrs_[i];
  mshrs_[i] = mshrs_[--num_mshrs_used_];
  stats_.sum_miss_latency += now - filled.since;
  const bool dirty = filled.dirty && !writes_arrived(line, now);
  if (!spec_.write.allocate) return filled.waiters;
  if (was_loaded_ && array_.touch(line)) {
    if (dirty) array_.mark_dirty(line);
    return filled.waiters;
  }
  const CacheArray::Victim victim = array_.fill(line, dirty);
  for (std::uint32_t left = victim.dirty; left != 0; left &= left - 1) {
    write_back(victim.line + static_cast<std::uint32_t>(std::countr_zero(left)), now);
  }
  return filled.waiters;
}

// Of a line that was written while it was on its way; false if it stays to be written back.
bool PrivateCache::writes_arrived(std::uint64_t line, Cycles now) {
  if (spec_.write.policy == WritePolicy::kThrough) {
    ++stats_.num_writes_through;
    send_write(line << line_shift_, line_size(), now);
    return true;
  }
  if (!spec_.write.allocate) write_back(line, now);
  return !spec_.write.allocate;
}

void PrivateCache::write_back(std::uint64_t line, Cycles now) {
  ++stats_.num_writebacks;
  send_write(line << line_shift_, line_size(), now);
}

void PrivateCache::send_write(Address address, Bytes bytes, Cycles now) {
  const bool bounded = spec_.write.buffer != 0;
  if (bounded) ++num_writes_out_;
  stats_.bytes_written += bytes;
  requests_.write_ahead(
      {address, static_cast<std::uint32_t>(bytes), requester_, written_kind_, true, bounded}, now,
      requester_);
}

void PrivateCache::load(const CacheArray& tags) {
  array_ = tags;
  was_loaded_ = true;
}

std::vector<std::uint64_t> PrivateCache::take_dirty_lines() {
  std::vector<std::uint64_t> lines;
  array_.clean_all([&](std::uint64_t line) { lines.push_back(line); });
  return lines;
}

}  // namespace sheaf
