// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "kdtree/build.h"
#include "stability/mesh_scene.h"
#include "stability/shaded_mesh.h"

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

/// Along one axis or nearly: the other components are zeros of either sign, denormal or tiny.
inline Vec3 any_odd_direction() {
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    direction[axis] =
        *rc::gen::element(0.0F, -0.0F, 1e-45F, -1e-45F, 1e-40F, -1e-40F, 1e-30F, -1e-7F, 1e-7F);
  }
  direction[*rc::gen::inRange(0, 3)] = *rc::gen::element(1.0F, -1.0F);
  return direction;
}

/// Between two points, or odd; in one of three cases it ends, often at the distance of a point.
inline Ray any_ray() {
  const Vec3 from = any_point();
  const Vec3 to = any_point();
  const bool odd = from == to || *rc::gen::inRange(0, 3) == 0;
  Ray ray = make_ray(from, odd ? any_odd_direction() : glm::normalize(to - from));
  if (*rc::gen::inRange(0, 3) == 0) {
    ray.t_max = *rc::gen::element(0.0F, 1e-45F, 0.25F, 0.5F, 1.0F, glm::length(to - from));
  }
  return ray;
}

/// Every mixture of mirror, glass and lamp, with none to two lights.
inline Scene any_scene() {
  Material material;
  material.mirror_weight = 0.25F * static_cast<float>(*rc::gen::inRange(0, 5));
  material.transmission = (1.0F - material.mirror_weight) * *rc::gen::element(0.0F, 0.5F, 1.0F);
  material.diffuse_weight = 1.0F - material.mirror_weight - material.transmission;
  material.emission = *rc::gen::element(Vec3(0.0F), Vec3(1.0F, 1e-30F, 1e30F));
  Scene scene = scene_of(any_mesh(), material);
  const int num_lights = *rc::gen::inRange(0, 3);
  for (int i = 0; i < num_lights; ++i) {
    Light light;
    light.position = any_point();
    light.intensity = Vec3(10.0F);
    scene.lights.push_back(light);
  }
  scene.background = Vec3(0.3F, 0.4F, 0.5F);
  return scene;
}

/// Settings of --set, drawn one by one.
struct AnySettings {
  void add(const std::string& key, int lowest, int highest) {
    all.push_back(fmt::format("{}={}", key, *rc::gen::inRange(lowest, highest + 1)));
  }
  template <typename... Values>
  void choose(const std::string& key, Values... values) {
    all.push_back(fmt::format("{}={}", key, *rc::gen::element(values...)));
  }
  std::vector<std::string> all;
};

/// Settings of a machine but for flow control: numbers of units, their speed, queues, both caches
/// of rays and the choices of what goes first.
inline AnySettings any_machine_but_flow() {
  AnySettings settings;
  for (const std::string unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    settings.add(unit + ".count", 1, 8);
    settings.add(unit + ".contexts", 1, 64);
    settings.add(unit + ".latency", 1, 1000);
  }
  settings.add("ray_cache.cells", 1, 100);
  settings.add("ray_cache.timeout", 0, 1000);
  settings.add("packet_fifo.depth", 1, 100);
  settings.add("packet.size", 1, 64);
  settings.add("flow.tile_size", 8, 64);
  settings.add("link.latency", 1, 100);
  settings.add("link.depth", 1, 100);
  settings.choose("ray_cache.heuristic", "none", "dir", "mdir(24)", "fastpos", "pos(1)", "opos",
                  "ray5d(1)", "grid(2)");
  settings.choose("ray_cache.victim", "fullest", "oldest", "lru");
  settings.choose("ray_cache.order", "arrival", "breadth_first");
  settings.choose("ray_cache.group_by_kind", "false", "true");
  settings.choose("shader_cache.cells", 0, 0, 1, 16);
  settings.choose("shader_cache.key", "material", "texture");
  settings.choose("packet_arbiter.policy", "alternate", "primary_first", "secondary_first");
  settings.choose("traversal.scheme", "single", "masked", "interval", "interval_entry", "omni");
  return settings;
}

inline std::vector<std::string> any_machine() {
  AnySettings settings = any_machine_but_flow();
  settings.choose("flow.control", "tile", "credits", "spill");
  settings.choose("flow.spill_queue", 1, 16, 128);
  return settings.all;
}

/// One whose memory traffic can be recorded, which that of spilled rays cannot.
inline std::vector<std::string> any_recordable_machine() {
  AnySettings settings = any_machine_but_flow();
  settings.choose("flow.control", "tile", "credits");
  return settings.all;
}

/// A machine in which what happens next never depends on time: one unit of each kind with one
/// context, so that all queues are first in, first out; a tile of one primary packet, so that the
/// arbiter never has to choose between it and what it spawned; cells that no time-out closes. It
/// is swept when nothing moves, which is one state, whenever it is reached.
inline std::vector<std::string> any_orderly_machine() {
  AnySettings settings;
  for (const std::string unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    settings.choose(unit + ".count", 1);
    settings.choose(unit + ".contexts", 1);
    settings.add(unit + ".latency", 1, 100);
    settings.add(unit + ".initiation_interval", 1, 20);
    settings.choose(unit + ".lanes", 1, 4, 16);
  }
  const int side = *rc::gen::element(1, 2, 4, 8);
  settings.choose("packet.size", side * side);
  settings.choose("flow.tile_size", side);
  settings.add("ray_cache.cells", 1, 20);
  settings.add("ray_cache.rays_per_cycle", 1, 8);
  settings.add("ray_cache.latency", 1, 50);
  settings.add("packet_fifo.depth", 1, 20);
  settings.add("packet_fifo.latency", 1, 50);
  settings.add("primary_source.interval", 1, 20);
  settings.add("link.latency", 1, 50);
  settings.add("link.depth", 1, 20);
  settings.choose("ray_cache.heuristic", "none", "dir", "mdir(24)", "fastpos", "pos(1)");
  settings.choose("traversal.scheme", "single", "masked", "interval", "interval_entry", "omni");
  return settings.all;
}

inline const std::vector<std::string> kPrivateCaches = {
    "node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film_cache"};

/// What the cache's own choices are, all but how many accesses may wait for what.
inline void choose_cache(AnySettings& settings, const std::string& cache) {
  settings.choose(cache + ".mode", "normal", "normal", "normal", "perfect", "absent");
  settings.choose(cache + ".sets", 1, 2, 32);
  settings.choose(cache + ".ways", 1, 2, 4);
  settings.choose(cache + ".replacement", "lru", "plru", "fifo", "random");
  settings.choose(cache + ".banks", 1, 2, 8);
  settings.add(cache + ".ports", 1, 3);
  settings.add(cache + ".hit_latency", 1, 20);
}

/// Settings of all behind the private caches: L2, links, crossbar and DRAM.
inline std::vector<std::string> any_shared_memory() {
  AnySettings settings;
  choose_cache(settings, "l2");
  settings.choose("l2.line", 64, 128);
  settings.add("l2.mshrs", 1, 16);
  settings.add("l2.mshr_targets", 0, 4);
  settings.choose("l2.write_policy", "back", "through");
  settings.choose("l2.write_allocate", "false", "true");
  settings.add("l2.write_buffer", 0, 4);
  settings.add("link.memory_latency", 1, 50);
  settings.choose("link.memory_width", 1, 8, 32, 4096);
  settings.choose("crossbar.request_width", 0, 0, 4, 64);
  settings.choose("crossbar.response_width", 0, 0, 4, 64);
  settings.choose("dram.model", "fixed", "fixed", "DDR4-2400", "HBM2-2000");
  settings.choose("dram.latency", 1, 20, 100, 1000);
  settings.choose("dram.bytes_per_cycle", 1, 16, 64);
  return settings.all;
}

}  // namespace sheaf::stability
