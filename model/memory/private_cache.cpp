// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/private_cache.h"

#include <bit>

namespace sheaf {
namespace {

std::uint32_t num_sets(const CacheSpec& spec) {
  if (spec.mode != CacheMode::kNormal) return 0;
  return static_cast<std::uint32_t>(spec.capacity / (spec.line * spec.ways));
}

}  // namespace

PrivateCache::PrivateCache(const CacheSpec& spec, TimedOut<LineRequest>& requests,
                           std::uint16_t requester)
    : spec_(spec),
      line_shift_(static_cast<unsigned>(std::countr_zero(spec.line))),
      array_(num_sets(spec), spec.ways),
      mshrs_(spec.mshrs),
      requests_(requests),
      requester_(requester) {}

PrivateCache::Result PrivateCache::modify(std::uint64_t line, DataKind kind, int waiter,
                                          Cycles now) {
  written_kind_ = kind;
  if (spec_.mode == CacheMode::kPerfect || array_.touch(line)) {
    count_hit(kind);
    if (spec_.mode == CacheMode::kNormal) array_.mark_dirty(line);
    return Result::kHit;
  }
  return miss(line, kind, waiter, true, now);
}

PrivateCache::Result PrivateCache::miss(std::uint64_t line, DataKind kind, int waiter, bool dirty,
                                        Cycles now) {
  const std::uint64_t bit = std::uint64_t{1} << waiter;
  for (std::uint32_t i = 0; i < num_mshrs_used_; ++i) {
    if (mshrs_[i].line != line) continue;
    mshrs_[i].waiters |= bit;
    mshrs_[i].dirty |= dirty;
    count_access(kind);
    ++stats_.num_merges;
    return Result::kPending;
  }
  if (num_mshrs_used_ == mshrs_.size()) {
    ++stats_.num_mshr_stalls;
    waiting_for_mshr_ |= bit;
    return Result::kNoMshr;
  }
  mshrs_[num_mshrs_used_++] = {line, bit, kind, dirty};
  count_access(kind);
  ++stats_.num_misses;
  stats_.bytes_read += spec_.line;
  requests_.write_ahead(
      {line << line_shift_, static_cast<std::uint32_t>(spec_.line), requester_, kind, false}, now,
      requester_);
  return Result::kPending;
}

std::uint64_t PrivateCache::fill(const LineResponse& response, Cycles now, std::uint64_t& retry) {
  const std::uint64_t line = line_of(response.address);
  std::uint32_t i = 0;
  while (mshrs_[i].line != line) ++i;
  const Mshr filled = mshrs_[i];
  mshrs_[i] = mshrs_[--num_mshrs_used_];
  retry |= waiting_for_mshr_;
  waiting_for_mshr_ = 0;
  const CacheArray::Victim victim = array_.fill(line, filled.dirty);
  if (victim.valid && victim.dirty) write_back(victim.line, now);
  return filled.waiters;
}

void PrivateCache::write_back(std::uint64_t line, Cycles now) {
  ++stats_.num_writebacks;
  stats_.bytes_written += spec_.line;
  requests_.write_ahead({line << line_shift_, static_cast<std::uint32_t>(spec_.line), requester_,
                         written_kind_, true},
                        now, requester_);
}

void PrivateCache::load(const CacheArray& tags) {
  array_ = tags;
  for (std::uint32_t i = 0; i < num_mshrs_used_; ++i) array_.remove(mshrs_[i].line);
}

std::vector<std::uint64_t> PrivateCache::take_dirty_lines() {
  std::vector<std::uint64_t> lines;
  array_.clean_all([&](std::uint64_t line) { lines.push_back(line); });
  return lines;
}

}  // namespace sheaf
