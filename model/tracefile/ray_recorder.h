// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "shading/shading_source.h"
#include "tracefile/ray_block.h"
#include "tracefile/trace_writer.h"

namespace sheaf {

/// Shades as another source does, and writes down what came of it. A block of pixels goes to the
/// file when its last ray has been shaded; if many are open at a time, the largest goes in parts.
class RayRecorder final : public ShadingSource {
 public:
  RayRecorder(ShadingSource& inner, TraceWriter& writer, std::uint32_t width, std::uint32_t height,
              std::size_t num_lights)
      : inner_(inner), writer_(writer), grid_(width, height), num_lights_(num_lights) {}

  void shade(const RayPacket& packet, PacketShading& out) override;

  /// Writes what is still open.
  void flush();

 private:
  struct OpenBlock {
    RayBlock content;
    std::uint64_t num_live = 0;  ///< rays of its pixels that are still to be shaded
  };
  void record(const RayPacket& packet, const PacketShading& shading);
  void order_children(const SpawnBundle& spawned);
  OpenBlock& open(std::uint64_t number);
  void write(std::uint64_t number, RayBlock& block);
  void write_largest();

  ShadingSource& inner_;
  TraceWriter& writer_;
  const BlockGrid grid_;
  const std::size_t num_lights_;
  std::unordered_map<std::uint64_t, OpenBlock> open_;
  std::uint64_t num_packets_ = 0;
  std::size_t open_bytes_ = 0;
  std::vector<SpawnedRay> children_;  ///< of one packet, by lane, then by slot
  std::array<std::uint32_t, kMaxPacketSize + 1> first_child_{};  ///< by lane
};

}  // namespace sheaf
