// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/film.h"

namespace sheaf::clocked {

StallCause FilmUnit::act(Cycles now) {
  while (cache_.line_has_arrived(now)) {
    if (cache_.take_line(now).of_mshr != 0) waits_for_mshr_ = false;
  }
  if (batch_ == nullptr && in_batches->has_arrived(now)) {
    batch_ = in_batches->read(now);
    ++stats_.num_batches;
  }
  if (batch_ != nullptr) {
    const bool added = !waits_for_mshr_ && add_next(now);
    return added ? StallCause::kBusy : StallCause::kWaitingMemory;
  }
  if (cache_.has_pending()) return StallCause::kWaitingMemory;
  if (flow_.finished(now) && in_batches->size() == 0) return flush_next(now);
  return StallCause::kIdle;
}

// False if there is no free MSHR; the lines asked for so far are not asked for again.
bool FilmUnit::add_next(Cycles now) {
  const PixelContribution& contribution = (*batch_)[position_];
  const Address first = memory_.pixel(contribution.pixel);
  const std::uint64_t first_line = cache_.line_of(first);
  const std::uint64_t last_line = cache_.line_of(first + film_.bytes_per_pixel() - 1);
  for (; first_line + lines_asked_ <= last_line; ++lines_asked_) {
    const auto result = cache_.access(first_line + lines_asked_, DataKind::kPixel, 0, true, now);
    if (result == Cache::Result::kNoMshr) {
      waits_for_mshr_ = true;
      return false;
    }
  }
  lines_asked_ = 0;
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
  if (dirty_lines_.empty()) {
    state_ = State::kDone;
    return StallCause::kIdle;
  }
  cache_.write_back(dirty_lines_.back(), DataKind::kPixel, now);
  dirty_lines_.pop_back();
  return StallCause::kBusy;
}

}  // namespace sheaf::clocked
