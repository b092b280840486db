// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/film_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

FilmUnit::FilmUnit(const sc_core::sc_module_name& name, const CacheSpec& cache, Film& film,
                   const MemoryMap& memory, ObjectPool<FilmBatch>& batches, FlowControl& flow,
                   ClockDomain& domain, TimedOut<LineRequest>& requests, std::uint16_t requester)
    : sc_module(name),
      SteppingAgent(domain),
      in_batches("in_batches"),
      in_lines("in_lines"),
      film_(film),
      memory_(memory),
      batches_(batches),
      flow_(flow),
      cache_(cache, requests, requester) {
  inbox_.bind(domain, domain.add(*this));
  flow.bind_film(inbox_);
}

void FilmUnit::end_of_elaboration() {
  in_batches->set_consumer(inbox_);
  in_lines->set_consumer(inbox_);
  cache_.bind(inbox_);
}

Cycles FilmUnit::act(Cycles now) {
  accept_lines(now);
  if (batch_ == nullptr && in_batches->has_arrived(now)) {
    batch_ = in_batches->read(now);
    position_ = 0;
    bytes_asked_for_ = 0;
    ++stats_.num_batches;
    recorded_ = 0;
    if (recorder_ != nullptr) {
      const AccessCause cause = recorder_->recorder().arrive_at_film();
      recorder_->begin(0, cause, cause.sent + link_latency_, now);
    }
  }
  const Cycles next_line = in_lines->next_arrival();
  if (batch_ != nullptr) {
    if (waits_for_room_ || !add_next(now)) {
      stalls_.switch_to(StallCause::kWaitingMemory, now);
      return next_line;
    }
    stalls_.switch_to(StallCause::kBusy, now);
    return now + 1;
  }
  const Cycles next = std::min(next_line, in_batches->next_arrival());
  const bool finished = flow_.finished(now) && next == kNever && !cache_.has_pending();
  if (flushing_ || finished) return flush_next(now);
  stalls_.switch_to(cache_.has_pending() ? StallCause::kWaitingMemory : StallCause::kIdle, now);
  return std::min(next, flow_.next_notice(now));
}

void FilmUnit::accept_lines(Cycles now) {
  while (in_lines->has_arrived(now)) {
    std::uint64_t retry = 0;
    cache_.fill(in_lines->read(now), now, retry);
    if (retry != 0) waits_for_room_ = false;
  }
}

// False if the cache has no room for it; the lines asked for so far are not asked for again.
bool FilmUnit::add_next(Cycles now) {
  const PixelContribution& contribution = (*batch_)[position_];
  const Address first = memory_.pixel(contribution.pixel);
  const Address end = first + film_.bytes_per_pixel();
  const Bytes line = cache_.line_size();
  if (recorder_ != nullptr && bytes_asked_for_ == 0 && recorded_ != position_ + 1) {
    recorded_ = position_ + 1;
    record_addition(first, now);
  }
  for (Address at = first + bytes_asked_for_; at != end; at = first + bytes_asked_for_) {
    const Bytes bytes = std::min(end, (cache_.line_of(at) + 1) * line) - at;
    if (cache_.modify(at, bytes, DataKind::kPixel, 0, now) == PrivateCache::Result::kNoMshr) {
      waits_for_room_ = true;
      return false;
    }
    bytes_asked_for_ += bytes;
  }
  bytes_asked_for_ = 0;
  film_.add(contribution.pixel, contribution.radiance);
  ++stats_.num_contributions;
  if (++position_ == batch_->size()) {
    batch_->clear();
    batches_.release(batch_);
    batch_ = nullptr;
    if (recorder_ != nullptr) recorder_->end(0, now + 1);
  }
  return true;
}

void FilmUnit::record_addition(Address pixel, Cycles now) {
  const std::uint32_t operation = recorder_->operation(0, [&] {
    return MemoryOperation{.kind = DataKind::kPixel,
                           .bytes = static_cast<std::uint32_t>(film_.bytes_per_pixel()),
                           .write = true};
  });
  recorder_->step(0, operation, pixel, position_ + 1 == batch_->size(), now);
}

Cycles FilmUnit::flush_next(Cycles now) {
  if (!flushing_) {
    flushing_ = true;
    dirty_lines_ = cache_.take_dirty_lines();
  }
  if (dirty_lines_.empty()) {
    stalls_.switch_to(cache_.has_pending() ? StallCause::kWaitingMemory : StallCause::kIdle, now);
    return in_lines->next_arrival();
  }
  if (!cache_.can_write()) {
    stalls_.switch_to(StallCause::kWaitingMemory, now);
    return in_lines->next_arrival();
  }
  cache_.write_back(dirty_lines_.back(), now);
  dirty_lines_.pop_back();
  stalls_.switch_to(StallCause::kBusy, now);
  return now + 1;
}

std::string FilmUnit::stuck_reason() const {
  if (batch_ == nullptr && !cache_.has_pending()) return {};
  return fmt::format("{}: {}", name(),
                     waits_for_room_ ? "waits for room in its cache" : "waits for memory");
}

}  // namespace sheaf
