// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/fixed_unit.h"

#include <algorithm>

#include "units/replayed_lines.h"

namespace sheaf {

FixedUnit::FixedUnit(const sc_core::sc_module_name& name, const MemoryLayout& layout,
                     MemoryStream records, ClockDomain& domain)
    : sc_module(name), layout_(layout), records_(std::move(records)), domain_(domain) {
  inbox_.bind(domain, domain.add(*this));
  domain.schedule(inbox_.agent(), 0);
}

void FixedUnit::add_cache(const CacheSpec& spec, TimedOut<LineRequest>& requests,
                          std::uint16_t requester, TimedIn<LineResponse>& lines) {
  caches_.push_back(std::make_unique<Own>(spec, requests, requester, lines));
  caches_.back()->cache.bind(inbox_);
  lines.set_consumer(inbox_);
}

bool FixedUnit::is_finished() const {
  return all_read_ && lines_.empty() &&
         std::ranges::none_of(caches_, [](const auto& own) { return own->cache.has_pending(); });
}

Cycles FixedUnit::wake(Cycles now) {
  for (;;) {
    const Cycles next = act(now);
    if (next >= domain_.horizon()) return next;
    now = next;
  }
}

Cycles FixedUnit::act(Cycles now) {
  domain_.happened(now);
  take_lines(now);
  Cycles next_line = kNever;
  for (const auto& own : caches_) next_line = std::min(next_line, own->lines.next_arrival());
  if (waits_for_mshr_) return next_line;
  if (lines_.empty() && !load_step()) return std::min(next_line, flush_next(now));
  if (step_.cycle > now) return std::min(next_line, step_.cycle);
  if (!present(now)) return next_line;
  return now + 1;
}

void FixedUnit::take_lines(Cycles now) {
  for (auto& own : caches_) {
    while (own->lines.has_arrived(now)) {
      std::uint64_t retry = 0;
      own->cache.fill(own->lines.read(now), now, retry);
      if (retry != 0) waits_for_mshr_ = false;
    }
  }
}

// The next step that accesses something.
bool FixedUnit::load_step() {
  const MemoryRecord* record = records_.peek();
  while (record != nullptr && layout_.operations[record->operation].bytes == 0) {
    records_.pop();
    record = records_.peek();
  }
  all_read_ = record == nullptr;
  if (all_read_) return false;
  step_ = *record;
  const MemoryOperation& operation = layout_.operations[step_.operation];
  const PrivateCache& cache = caches_[operation.cache]->cache;
  do {
    add_lines(record->address, operation.bytes, cache, lines_);
    records_.pop();
    record = records_.peek();
  } while (record != nullptr && record->continues);
  keep_each_once(lines_);
  std::ranges::reverse(lines_);
  return true;
}

// False if an MSHR is lacking.
bool FixedUnit::present(Cycles now) {
  const MemoryOperation& operation = layout_.operations[step_.operation];
  PrivateCache& cache = caches_[operation.cache]->cache;
  if (operation.write) {
    waits_for_mshr_ = !modify_all(cache, step_.address, operation, 0, bytes_done_, now);
    if (!waits_for_mshr_) lines_.clear();
    return !waits_for_mshr_;
  }
  for (; !lines_.empty(); lines_.pop_back()) {
    if (cache.read(lines_.back(), operation.kind, 0, now) == PrivateCache::Result::kNoMshr) {
      waits_for_mshr_ = true;
      return false;
    }
  }
  return true;
}

Cycles FixedUnit::flush_next(Cycles now) {
  if (dirty_cache_ == 0 && !is_finished()) return kNever;
  while (dirty_lines_.empty()) {
    if (dirty_cache_ == caches_.size()) return kNever;
    dirty_lines_ = caches_[dirty_cache_++]->cache.take_dirty_lines();
  }
  if (!caches_[dirty_cache_ - 1]->cache.can_write()) return kNever;
  caches_[dirty_cache_ - 1]->cache.write_back(dirty_lines_.back(), now);
  dirty_lines_.pop_back();
  return now + 1;
}

}  // namespace sheaf
