// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/traced_shading.h"

#include <bit>
#include <cmath>

#include "shading/texel_accesses.h"

namespace sheaf {
namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

RayKind kind_of(std::uint32_t slot) {
  return slot == 0 ? RayKind::kReflection : slot == 1 ? RayKind::kRefraction : RayKind::kShadow;
}

}  // namespace

void TracedShading::shade(const RayPacket& packet, PacketShading& out) {
  out.clear();
  if (failed()) return;
  try {
    look_up(packet, out);
    spawn(packet, out);
  } catch (...) {
    error_ = std::current_exception();
    out.clear();
  }
}

void TracedShading::look_up(const RayPacket& packet, PacketShading& out) {
  children_.clear();
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const RayTag& tag = packet.tag[lane];
    const bool hit = packet.hit_triangle[lane] != kNoHit;
    next_child_[lane] = end_child_[lane] = static_cast<std::uint32_t>(children_.size());
    bool contributes = false;
    if (tag.kind == RayKind::kShadow) {
      ++out.num_post_shaded;
      contributes = !hit;
    } else {
      const RayLookup::Found found = trace_.find(tag);
      if (found.ray->hit != hit) trace_.refuse(tag, "its hit is another than the recorded one");
      contributes = found.ray->contributes;
      if (hit) read_surface(packet, lane, out);
      keep_children(tag, found.children, lane);
    }
    if (contributes) {
      out.contributions.push_back({tag.pixel, packet.weight[lane]});
      out.contributed |= left & -left;
    }
  }
}

void TracedShading::read_surface(const RayPacket& packet, std::size_t lane,
                                 PacketShading& out) const {
  const Hit hit{packet.hit_t[lane], packet.hit_u[lane], packet.hit_v[lane],
                packet.hit_triangle[lane]};
  out.triangles.push_back(hit.triangle);
  add_texel_accesses(scene_, hit, out.texels);
}

void TracedShading::keep_children(const RayTag& tag, std::span<const SpawnedRay> children,
                                  std::size_t lane) {
  for (std::size_t i = 0; i < children.size(); ++i) {
    check_child(tag, children[i]);
    if (i != 0 && children[i].slot <= children[i - 1].slot) {
      trace_.refuse(tag, "the rays it spawned are out of order");
    }
  }
  children_.insert(children_.end(), children.begin(), children.end());
  end_child_[lane] = static_cast<std::uint32_t>(children_.size());
}

void TracedShading::check_child(const RayTag& parent, const SpawnedRay& child) const {
  const bool wanted = child.slot == 0   ? scene_.needs.reflection
                      : child.slot == 1 ? scene_.needs.refraction
                                        : child.slot - 2 < scene_.lights.size();
  if (!wanted) trace_.refuse(parent, "it spawned a ray that the scene cannot spawn");
  if (child.slot < 2 && parent.depth >= recursion_level_) {
    trace_.refuse(parent, "it spawned a ray beyond the recursion level");
  }
  // A sum of light that takes something away is none that a film adds up.
  const bool takes_away = glm::any(glm::lessThan(child.weight, Vec3(0.0F)));
  if (takes_away || !is_finite(child.origin) || !is_finite(child.direction) ||
      !is_finite(child.weight) || child.direction == Vec3(0.0F) || !(child.t_max >= 0.0F)) {
    trace_.refuse(parent, "it spawned a ray that is none");
  }
}

// In the order of PacketShader: slot by slot, and in each in lane order.
void TracedShading::spawn(const RayPacket& packet, PacketShading& out) {
  const auto group = [&](std::uint32_t slot) {
    out.spawned.begin_group();
    for (LaneMask left = packet.active; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const auto i = static_cast<std::size_t>(lane);
      if (next_child_[i] == end_child_[i] || children_[next_child_[i]].slot != slot) continue;
      const SpawnedRay& child = children_[next_child_[i]++];
      const RayTag tag{child_ray_id(packet.tag[i].id, slot), packet.tag[i].pixel,
                       static_cast<std::uint8_t>(packet.tag[i].depth + 1), kind_of(slot)};
      out.spawned.add({child.origin, child.t_max, child.direction, child.weight, tag}, lane);
    }
  };
  if (scene_.needs.reflection) group(0);
  if (scene_.needs.refraction) group(1);
  for (std::uint32_t light = 0; light < scene_.lights.size(); ++light) group(2 + light);
}

}  // namespace sheaf
