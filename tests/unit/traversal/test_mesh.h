// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stability/double_hit.h"
#include "stability/mesh_scene.h"

namespace sheaf::test {

using TestScene = stability::MeshScene;
using stability::bumpy_sphere;
using stability::explains;
using stability::Hit;
using stability::hit_in_doubles;
using stability::lattice;
using stability::make_ray;
using stability::Mesh;
using stability::random_direction;
using stability::random_packet;
using stability::random_point;
using stability::random_ray;
using stability::soup;
using stability::test_all;
using stability::trace_one;

}  // namespace sheaf::test
