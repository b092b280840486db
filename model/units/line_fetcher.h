// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>

#include "memory/private_cache.h"

namespace sheaf {

/// A context's progress through the lines that its step needs.
struct LineFetch {
  std::uint32_t next = 0;     ///< lines before this one have been asked for
  std::uint32_t pending = 0;  ///< of those, still on their way
  bool begun = false;         ///< a look-up has been made
};

/// Steps of a unit's contexts that need several lines of one private cache.
class LineFetcher {
 public:
  explicit LineFetcher(PrivateCache& cache) : cache_(cache) {}

  struct Outcome {
    bool complete = false;   ///< every line is there
    Cycles port_cycles = 0;  ///< in which the look-ups made now find a port
  };

  /// Asks for the lines that the context's step has not asked for yet; line(i) is the i-th of
  /// num_lines. Incomplete: wait for fill() to name the context.
  template <typename LineOf>
  Outcome fetch(int context, std::uint32_t num_lines, DataKind kind, const LineOf& line,
                Cycles now) {
    LineFetch& progress = progress_[static_cast<std::size_t>(context)];
    Outcome outcome;
    progress.begun = true;
    while (progress.next < num_lines) {
      ++outcome.port_cycles;
      const auto result = cache_.read(line(progress.next), kind, context, now);
      if (result == PrivateCache::Result::kNoMshr) break;
      if (result == PrivateCache::Result::kPending) ++progress.pending;
      ++progress.next;
    }
    if (!cache_.is_plain()) {
      // The last look-up came to nothing if a line is left.
      const std::uint32_t end = progress.next + (progress.next < num_lines ? 1 : 0);
      const auto looked_up = static_cast<std::uint32_t>(outcome.port_cycles);
      outcome.port_cycles = cache_.port_cycles(end - looked_up, end, line);
    }
    outcome.complete = progress.next == num_lines && progress.pending == 0;
    if (outcome.complete) progress = {};
    return outcome;
  }

  /// Whether the context's step has been issued before and still misses lines.
  [[nodiscard]] bool has_begun(int context) const {
    return progress_[static_cast<std::size_t>(context)].begun;
  }

  /// The same for a step that needs one line.
  bool fetch_one(int context, std::uint64_t line, DataKind kind, Cycles now) {
    LineFetch& progress = progress_[static_cast<std::size_t>(context)];
    if (progress.next != 0) {  // it has come
      progress = {};
      return true;
    }
    const auto result = cache_.read(line, kind, context, now);
    if (result == PrivateCache::Result::kPending) progress = {1, 1, true};
    if (result == PrivateCache::Result::kNoMshr) progress.begun = true;
    if (result == PrivateCache::Result::kHit) progress.begun = false;
    return result == PrivateCache::Result::kHit;
  }

  /// Takes an arrived line in; calls ready(context) for each context that may be issued again.
  template <typename Ready>
  void fill(const LineResponse& response, Cycles now, const Ready& ready) {
    std::uint64_t retry = 0;
    std::uint64_t waiters = cache_.fill(response, now, retry);
    for (std::uint64_t left = waiters; left != 0; left &= left - 1) {
      const int context = std::countr_zero(left);
      if (--progress_[static_cast<std::size_t>(context)].pending == 0) retry |= left & -left;
    }
    for (std::uint64_t left = retry; left != 0; left &= left - 1) {
      const int context = std::countr_zero(left);
      if (progress_[static_cast<std::size_t>(context)].pending == 0) ready(context);
    }
  }

 private:
  PrivateCache& cache_;
  std::array<LineFetch, 64> progress_{};
};

}  // namespace sheaf
