// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/prepared_scene.h"

#include <thread>

#include "base/huge_pages.h"
#include "image/film.h"
#include "kdtree/build.h"

namespace sheaf {
namespace {

KdTree make_tree(const Scene& scene, const KdTreeSpec& spec, const TreeCache* trees) {
  const KdBuildOptions options{.traversal_cost = spec.traversal_cost,
                               .intersection_cost = spec.intersection_cost,
                               .empty_bonus = spec.empty_bonus,
                               .max_depth = static_cast<int>(spec.max_depth),
                               .threads = std::thread::hardware_concurrency()};
  if (trees != nullptr) return trees->get(scene.positions, scene.triangles, options);
  return build_kd_tree(scene.positions, scene.triangles, options);
}

std::vector<TriangleRecord> make_records(const Scene& scene) {
  std::vector<TriangleRecord> records;
  reserve_on_huge_pages(records, scene.triangles.size());
  for (const auto& corners : scene.triangles) {
    records.push_back(
        {scene.positions[corners[0]], scene.positions[corners[1]], scene.positions[corners[2]]});
  }
  return records;
}

}  // namespace

MemoryMap map_memory(const Scene& scene, const KdTree& tree, const Config& config) {
  MemoryCounts counts;
  counts.nodes = tree.nodes.size();
  counts.leaf_entries = tree.leaf_triangles.size();
  counts.triangles = scene.triangles.size();
  counts.vertices = scene.positions.size();
  counts.materials = scene.materials.size();
  for (const Texture& texture : scene.textures) {
    counts.textures.push_back({texture.width, texture.height});
  }
  counts.pixels = std::uint64_t{config.image.width} * config.image.height;
  counts.bytes_per_pixel = make_film(config.film.format, 1)->bytes_per_pixel();
  return MemoryMap(counts);
}

PreparedScene::PreparedScene(Scene&& loaded, const Config& config, const TreeCache* trees)
    : scene(std::move(loaded)),
      tree(make_tree(scene, config.kdtree, trees)),
      triangles(make_records(scene)),
      memory(map_memory(scene, tree, config)) {}

}  // namespace sheaf
