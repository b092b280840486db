// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/paged_array.h"
#include "shading/shading_source.h"

namespace sheaf {

/// What primary hits leave for the picture's auxiliary layers; all are indexed by pixel.
struct AuxiliaryLayers {
  PagedArray<Vec3> albedo;
  PagedArray<Vec3> normal;
  PagedArray<float> depth;  ///< distance along the ray; 0 where nothing was hit
  explicit AuxiliaryLayers(std::size_t num_pixels)
      : albedo(num_pixels), normal(num_pixels), depth(num_pixels) {}
};

/// Shades traced packets ray by ray: pre-shading where a ray hit something, background where it
/// left the scene, post-shading where a shadow ray met no occluder.
class PacketShader final : public ShadingSource {
 public:
  /// `layers` may be null.
  PacketShader(const Scene& scene, const Shader::Options& options, AuxiliaryLayers* layers)
      : scene_(scene), shader_(scene, options), layers_(layers) {}

  void shade(const RayPacket& packet, PacketShading& out) override;

 private:
  struct Lane;
  static void add(int lane, std::uint32_t pixel, const Vec3& radiance, PacketShading& out);
  void pre_shade(const Lane* lanes, std::size_t num_lanes, PacketShading& out) const;
  void keep_layers(const Lane& lane) const;

  const Scene& scene_;
  Shader shader_;
  AuxiliaryLayers* layers_;
};

}  // namespace sheaf
