// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/ray.h"

namespace sheaf {

/// Groups of spawned rays that ray_cache.group_by_kind keeps apart: reflections, refractions and
/// shadow rays (Boulos et al., "Packet-based Whitted and distribution ray tracing", 2007).
inline constexpr std::size_t kNumKindGroups = 3;
[[nodiscard]] inline std::size_t kind_group(RayKind kind) {
  if (kind == RayKind::kShadow) return 2;
  return kind == RayKind::kRefraction ? 1 : 0;
}

}  // namespace sheaf
