// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "shading/packet_shader.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// Traversal → intersection: test a packet against the first num_tests triangles of a leaf.
struct LeafJob {
  std::uint32_t leaf = 0;  ///< node number
  std::uint32_t num_tests = 0;
  std::uint16_t unit = 0;  ///< traversal unit and context that wait for the answer
  std::uint16_t context = 0;
};

/// Intersection → traversal: the job of this context is done.
struct LeafDone {
  std::uint16_t context = 0;
};

/// Traversal → arbiter: this unit has a free context.
struct ContextFree {
  std::uint16_t unit = 0;
};

}  // namespace sheaf
