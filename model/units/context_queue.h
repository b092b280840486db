// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/units.h"
#include "channels/calendar.h"

namespace sheaf {

/// Up to 64 contexts of a unit in the order of the times at which they are to go on; of the same
/// cycle the lowest number first. Steps mostly take equally long, so a new one mostly belongs at
/// the end, where looking for its place begins.
class ContextAgenda {
 public:
  static constexpr std::size_t kMaxContexts = 64;

  /// `context` must not be in the agenda; `time` is below Calendar::kEndOfTime.
  void insert(int context, Cycles time) {
    const Key key = time << kContextBits | static_cast<Key>(context);
    std::uint32_t position = end_++;
    for (; position != begin_ && key < at(position - 1); --position)
      at(position) = at(position - 1);
    at(position) = key;
  }
  /// Time of the first context, or kNever.
  [[nodiscard]] Cycles next() const {
    return begin_ == end_ ? kNever : keys_[begin_ % kMaxContexts] >> kContextBits;
  }
  /// The first context; there must be one.
  [[nodiscard]] int first() const {
    return static_cast<int>(keys_[begin_ % kMaxContexts] % kMaxContexts);
  }
  /// Takes the first context out; there must be one.
  int pop() { return static_cast<int>(keys_[begin_++ % kMaxContexts] % kMaxContexts); }

 private:
  using Key = std::uint64_t;
  static constexpr unsigned kContextBits = 6;
  static_assert(Calendar::kEndOfTime < Key{1} << (64U - kContextBits));
  [[nodiscard]] Key& at(std::uint32_t position) { return keys_[position % kMaxContexts]; }

  std::array<Key, kMaxContexts> keys_{};
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
};

/// Contexts that wait for the issue port, first come, first served.
class ReadyQueue {
 public:
  void push(int context) {
    contexts_[end_++ % ContextAgenda::kMaxContexts] = static_cast<std::uint8_t>(context);
  }
  [[nodiscard]] bool is_empty() const { return begin_ == end_; }
  /// There must be one.
  int pop() { return contexts_[begin_++ % ContextAgenda::kMaxContexts]; }

 private:
  std::array<std::uint8_t, ContextAgenda::kMaxContexts> contexts_{};
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
};

}  // namespace sheaf
