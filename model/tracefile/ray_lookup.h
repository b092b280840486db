// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracefile/ray_block.h"
#include "tracefile/trace_reader.h"

namespace sheaf {

/// Finds the rays of a ray trace by identity. Holds the blocks used last, so that memory is bounded
/// whatever the trace's size and the order in which rays are asked for.
class RayLookup {
 public:
  /// Throws Error(kTrace) if the trace is of a picture of another size.
  RayLookup(TraceReader& reader, std::uint32_t width, std::uint32_t height);

  struct Found {
    const ShadedRay* ray;
    std::span<const SpawnedRay> children;
  };
  /// What came of a ray that is no shadow ray; valid until the next call. Throws Error(kTrace) if
  /// it is not there or its block is damaged, repeats a ray or takes more than 1 GiB.
  [[nodiscard]] Found find(const RayTag& tag);

  /// Throws Error(kTrace): something is wrong with one ray.
  [[noreturn]] void refuse(const RayTag& tag, const std::string& problem) const;

 private:
  struct Block {
    std::uint64_t number = 0;
    RayBlock content;
    std::vector<std::uint32_t> slots;  ///< hash table: number of a ray + 1, 0 = empty
    std::size_t num_probes = 0;        ///< slots that were taken when one was sought
    std::uint64_t last_use = 0;
    [[nodiscard]] std::size_t num_bytes() const {
      return content.num_bytes() + slots.size() * sizeof(slots[0]);
    }
  };
  Block& block(std::uint64_t number);
  std::unique_ptr<Block> load(std::uint64_t number);
  void index(Block& block, const TraceFrame& frame) const;
  [[noreturn]] void refuse_size(const TraceFrame& frame) const;
  void make_room();

  TraceReader& reader_;
  const BlockGrid grid_;
  const std::uint32_t width_;
  std::vector<TraceFrame> frames_;  ///< by block, then in the order of the file
  std::unordered_map<std::uint64_t, std::unique_ptr<Block>> blocks_;
  Block* last_ = nullptr;
  std::size_t held_bytes_ = 0;
  std::uint64_t num_uses_ = 0;
  ByteVector raw_;
};

}  // namespace sheaf
