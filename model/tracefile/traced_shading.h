// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <exception>

#include "scene/scene.h"
#include "shading/shading_source.h"
#include "tracefile/ray_lookup.h"

namespace sheaf {

/// What came of traced packets, taken from a ray trace instead of computed: spawned rays and which
/// rays add to their pixel. The triangles and texels that shading reads follow from the hits and
/// the scene. What is added to a pixel is not in the trace; its place in time is.
///
/// Called from within a simulation, where exceptions have nowhere to go: what is wrong with the
/// trace is remembered, nothing is spawned any more, and rethrow() throws it.
class TracedShading final : public ShadingSource {
 public:
  TracedShading(const Scene& scene, std::uint32_t recursion_level, RayLookup& trace)
      : scene_(scene), recursion_level_(recursion_level), trace_(trace) {}

  void shade(const RayPacket& packet, PacketShading& out) override;

  [[nodiscard]] bool failed() const { return error_ != nullptr; }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void look_up(const RayPacket& packet, PacketShading& out);
  void read_surface(const RayPacket& packet, std::size_t lane, PacketShading& out) const;
  void keep_children(const RayTag& tag, std::span<const SpawnedRay> children, std::size_t lane);
  void check_child(const RayTag& parent, const SpawnedRay& child) const;
  void spawn(const RayPacket& packet, PacketShading& out);

  const Scene& scene_;
  const std::uint32_t recursion_level_;
  RayLookup& trace_;
  std::exception_ptr error_;
  // Children of the packet in hand, by lane; spawn() takes them slot by slot.
  std::vector<SpawnedRay> children_;
  Lanes<std::uint32_t> next_child_{};
  Lanes<std::uint32_t> end_child_{};
};

}  // namespace sheaf
