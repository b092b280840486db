// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/object_pool.h"
#include "image/film.h"
#include "kdtree/memory_map.h"
#include "units/clocked/cache.h"
#include "units/clocked/unit.h"
#include "units/film_unit.h"
#include "units/flow_control.h"

namespace sheaf::clocked {

/// Adds contributions to the frame buffer, one a cycle; when the last ray has retired, writes the
/// dirty lines back, one a cycle.
class FilmUnit final : public Unit {
 public:
  FilmUnit(std::string name, Film& film, const MemoryMap& memory, ObjectPool<FilmBatch>& batches,
           FlowControl& flow, Cache cache)
      : Unit(std::move(name)),
        film_(film),
        memory_(memory),
        batches_(batches),
        flow_(flow),
        cache_(std::move(cache)) {}

  Link<FilmBatch*>* in_batches = nullptr;

  /// Everything has been added and written back.
  [[nodiscard]] bool is_done() const { return state_ == State::kDone; }

  [[nodiscard]] const FilmStats& stats() const { return stats_; }
  [[nodiscard]] const Cache& cache() const { return cache_; }

 private:
  enum class State : std::uint8_t { kAdding, kFlushing, kDone };
  StallCause act(Cycles now) override;
  bool add_next(Cycles now);
  [[nodiscard]] StallCause flush_next(Cycles now);

  Film& film_;
  const MemoryMap& memory_;
  ObjectPool<FilmBatch>& batches_;
  FlowControl& flow_;
  Cache cache_;
  State state_ = State::kAdding;
  FilmBatch* batch_ = nullptr;  ///< being added
  std::size_t position_ = 0;
  Bytes bytes_asked_ = 0;  ///< of the contribution at position_
  bool waits_for_room_ = false;
  std::vector<std::uint64_t> dirty_lines_;
  FilmStats stats_;
};

}  // namespace sheaf::clocked
