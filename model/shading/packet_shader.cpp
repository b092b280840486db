// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/packet_shader.h"

#include <array>
#include <bit>

namespace sheaf {

/// A lane that hit something and is pre-shaded.
struct PacketShader::Lane {
  int number = 0;
  float t = 0.0F;
  Ray ray;
  Surface surface;
};

void PacketShading::clear() {
  contributions.clear();
  contributed = 0;
  triangles.clear();
  texels.clear();
  spawned.clear();
  num_post_shaded = 0;
}

void PacketShader::add(int lane, std::uint32_t pixel, const Vec3& radiance, PacketShading& out) {
  if (radiance == Vec3(0.0F)) return;
  out.contributions.push_back({pixel, radiance});
  out.contributed |= LaneMask{1} << lane;
}

void PacketShader::shade(const RayPacket& packet, PacketShading& out) {
  out.clear();
  std::array<Lane, kMaxPacketSize> lanes;
  std::size_t num_lanes = 0;
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const int number = std::countr_zero(left);
    const auto i = static_cast<std::size_t>(number);
    const bool hit = packet.hit_triangle[i] != kNoHit;
    if ((packet.any_hit >> number & 1U) != 0) {
      ++out.num_post_shaded;
      if (!hit) add(number, packet.tag[i].pixel, packet.weight[i], out);
      continue;
    }
    const Ray ray = packet.get(number);
    if (!hit) {
      add(number, ray.tag.pixel, shader_.missed(ray), out);
      continue;
    }
    const Hit at{packet.hit_t[i], packet.hit_u[i], packet.hit_v[i], packet.hit_triangle[i]};
    Lane& lane = lanes[num_lanes++];
    lane.number = number;
    lane.t = at.t;
    lane.ray = ray;
    lane.surface = shader_.surface(ray, at);
    out.triangles.push_back(at.triangle);
    for (int k = 0; k < lane.surface.num_texels; ++k) {
      out.texels.push_back(lane.surface.texels[static_cast<std::size_t>(k)]);
    }
    add(number, ray.tag.pixel, shader_.emitted(ray, lane.surface), out);
    if (layers_ != nullptr && ray.tag.kind == RayKind::kPrimary) keep_layers(lane);
  }
  pre_shade(lanes.data(), num_lanes, out);
}

void PacketShader::pre_shade(const Lane* lanes, std::size_t num_lanes, PacketShading& out) const {
  Ray spawned;
  if (scene_.needs.reflection) {
    out.spawned.begin_group();
    for (const Lane* lane = lanes; lane != lanes + num_lanes; ++lane) {
      if (shader_.reflect(lane->ray, lane->surface, spawned)) {
        out.spawned.add(spawned, lane->number);
      }
    }
  }
  if (scene_.needs.refraction) {
    out.spawned.begin_group();
    for (const Lane* lane = lanes; lane != lanes + num_lanes; ++lane) {
      if (shader_.refract(lane->ray, lane->surface, spawned)) {
        out.spawned.add(spawned, lane->number);
      }
    }
  }
  for (std::uint32_t light = 0; light < scene_.lights.size(); ++light) {
    out.spawned.begin_group();
    for (const Lane* lane = lanes; lane != lanes + num_lanes; ++lane) {
      if (shader_.shadow(lane->ray, lane->surface, light, spawned)) {
        out.spawned.add(spawned, lane->number);
      }
    }
  }
}

void PacketShader::keep_layers(const Lane& lane) const {
  const std::uint32_t pixel = lane.ray.tag.pixel;
  layers_->albedo[pixel] = lane.surface.base_color;
  layers_->normal[pixel] = lane.surface.shading_normal;
  layers_->depth[pixel] = lane.t;
}

}  // namespace sheaf
