// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/film.h"

#include <algorithm>

namespace sheaf::clocked {

StallCause FilmUnit::act(Cycles now) {
  while (cache_.has_response(now)) {
    if (cache_.take_response(now).of_room != 0) waits_for_room_ = false;
  }
  if (batch_ == nullptr && in_batches->has_arrived(now)) {
    batch_ = in_batches->read(now);
    ++stats_.num_batches;
  }
  if (batch_ != nullptr) {
    const bool added = !waits_for_room_ && add_next(now);
    return added ? StallCause::kBusy : StallCause::kWaitingMemory;
  }
  const bool finished = flow_.finished(now) && in_batches->size() == 0 && !cache_.has_pending();
  if (finished || state_ == State::kFlushing) return flush_next(now);
  return cache_.has_pending() ? StallCause::kWaitingMemory : StallCause::kIdle;
}

// False if the cache has no room; the lines asked for so far are not asked for again.
bool FilmUnit::add_next(Cycles now) {
  const PixelContribution& contribution = (*batch_)[position_];
  const Address first = memory_.pixel(contribution.pixel);
  const Address end = first + film_.bytes_per_pixel();
  while (first + bytes_asked_ != end) {
    const Address at = first + bytes_asked_;
    const Address line_end = (cache_.line_of(at) + 1) * cache_.line_size();
    const Bytes bytes = std::min(end, line_end) - at;
    if (cache_.modify(at, bytes, DataKind::kPixel, 0, now) == Cache::Result::kNoRoom) {
      waits_for_room_ = true;
      return false;
    }
    bytes_asked_ += bytes;
  }
  bytes_asked_ = 0;
  film_.add(contribution.pixel, contribution.radiance);
  ++stats_.num_contributions;
  if (++position_ == batch_->size()) {
    batch_->clear();
    batches_.release(batch_);
    batch_ = nullptr;
    position_ = 0;
  }
  return true;
}

StallCause FilmUnit::flush_next(Cycles now) {
  if (state_ == State::kAdding) {
    state_ = State::kFlushing;
    dirty_lines_ = cache_.take_dirty_lines();
  }
  if (dirty_lines_.empty() && !cache_.has_pending()) {
    state_ = State::kDone;
    return StallCause::kIdle;
  }
  if (dirty_lines_.empty() || !cache_.can_write()) return StallCause::kWaitingMemory;
  cache_.write_back(dirty_lines_.back(), DataKind::kPixel, now);
  dirty_lines_.pop_back();
  return StallCause::kBusy;
}

}  // namespace sheaf::clocked
