// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "kdtree/build.h"
#include "stability/mesh_scene.h"

// What properties are tried on. RapidCheck prints the seed of a failure and shrinks it towards
// small numbers; RC_PARAMS="seed=…" repeats it.
namespace sheaf::stability {

/// Coordinates that meet often: multiples of 1/4, so that triangles share planes, edges and
/// corners.
inline Vec3 any_point() {
  const auto coordinate = [] { return 0.25F * static_cast<float>(*rc::gen::inRange(-8, 9)); };
  const float x = coordinate();
  const float y = coordinate();
  return {x, y, coordinate()};
}

inline Mesh any_mesh() {
  Mesh mesh;
  const int count = *rc::gen::inRange(1, 40);
  for (int i = 0; i < count; ++i) {
    const Vec3 a = any_point();
    const Vec3 b = any_point();
    mesh.add(a, b, any_point());
  }
  return mesh;
}

/// From one triangle a leaf to one leaf for all.
inline KdBuildOptions any_tree() {
  KdBuildOptions options;
  options.traversal_cost = *rc::gen::element(0.01, 1.0, 15.0, 1000.0);
  options.empty_bonus = *rc::gen::element(0.01, 0.8, 1.0);
  options.max_depth = *rc::gen::inRange(0, 40);
  return options;
}

inline Ray any_ray() {
  const Vec3 from = any_point();
  const Vec3 to = any_point();
  return make_ray(from, from == to ? Vec3(0.0F, 0.0F, 1.0F) : glm::normalize(to - from));
}

/// Settings of a machine: numbers of units, their speed, queues and the ray cache.
inline std::vector<std::string> any_machine() {
  std::vector<std::string> settings;
  const auto add = [&](const std::string& key, int lowest, int highest) {
    settings.push_back(fmt::format("{}={}", key, *rc::gen::inRange(lowest, highest + 1)));
  };
  for (const std::string unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    add(unit + ".count", 1, 8);
    add(unit + ".contexts", 1, 64);
    add(unit + ".latency", 1, 1000);
  }
  add("ray_cache.cells", 1, 100);
  add("ray_cache.timeout", 0, 1000);
  add("packet_fifo.depth", 1, 100);
  add("packet.size", 1, 64);
  add("flow.tile_size", 8, 64);
  add("link.latency", 1, 100);
  add("link.depth", 1, 100);
  const auto choose = [&](const char* key, auto... values) {
    settings.push_back(fmt::format("{}={}", key, *rc::gen::element(values...)));
  };
  choose("ray_cache.heuristic", "none", "dir", "mdir(24)", "fastpos", "pos(1)", "opos");
  choose("traversal.scheme", "single", "masked", "interval", "interval_entry", "omni");
  choose("flow.control", "tile", "credits");
  return settings;
}

}  // namespace sheaf::stability
