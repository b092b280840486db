// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/shading_sorter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rays.h"

namespace sheaf {
namespace {

using IdLists = std::vector<std::vector<std::uint64_t>>;

/// One triangle a material: 0 and 1 without a texture, 2 and 3 with the same.
Scene four_materials() {
  Scene scene;
  scene.materials.resize(4);
  scene.materials[2].base_color_texture = 0;
  scene.materials[3].base_color_texture = 0;
  scene.triangle_material = {0, 1, 2, 3};
  return scene;
}

struct Bench {
  Bench(int packet_size, std::uint32_t cells, ShaderCacheKey key = ShaderCacheKey::kMaterial)
      : pool(packet_size), sorter({cells, key, 4}, scene, pool) {}

  /// Takes a packet whose rays hit these triangles; returns what leaves. Rays are numbered from 1.
  IdLists insert(const std::vector<std::uint32_t>& triangles, RayKind kind = RayKind::kReflection) {
    RayPacket* packet = pool.acquire();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      packet->put(static_cast<int>(i), ray_of(++id, Vec3(1.0F), Vec3(0.0F), kind));
      packet->hit_triangle[i] = triangles[i];
      packet->hit_t[i] = static_cast<float>(id);
      packet->hit_u[i] = static_cast<float>(id) + 0.25F;
      packet->hit_v[i] = static_cast<float>(id) + 0.5F;
    }
    departures.clear();
    sorter.insert(packet, departures);
    return ids_of(departures);
  }
  IdLists sweep() {
    departures.clear();
    sorter.sweep(departures);
    return ids_of(departures);
  }

  const Scene scene = four_materials();
  PacketPool pool;
  ShadingSorter sorter;
  std::vector<RayPacket*> departures;
  std::uint64_t id = 0;
};

TEST(ShadingSorter, GathersRaysThatMetTheSameMaterial) {
  Bench bench(3, 4);
  EXPECT_TRUE(bench.insert({0, 1, 0}).empty());
  EXPECT_EQ(bench.sorter.num_waiting(), 3U);
  EXPECT_EQ(bench.insert({1, 0}), (IdLists{{1, 3, 5}}));
  EXPECT_EQ(bench.insert({1}), (IdLists{{2, 4, 6}}));
  EXPECT_EQ(bench.sorter.num_waiting(), 0U);
  EXPECT_EQ(bench.pool.num_out(), 2U);
}

TEST(ShadingSorter, CarriesEachRaysHitAlong) {
  Bench bench(2, 4);
  bench.insert({0, 1});
  bench.insert({1, 0});
  for (const RayPacket* packet : bench.departures) {
    for (std::size_t lane = 0; lane < 2; ++lane) {
      const auto id = static_cast<float>(packet->tag[lane].id);
      EXPECT_EQ(packet->hit_t[lane], id);
      EXPECT_EQ(packet->hit_u[lane], id + 0.25F);
      EXPECT_EQ(packet->hit_v[lane], id + 0.5F);
      EXPECT_EQ(packet->hit_triangle[lane], packet->hit_triangle[0]);
    }
  }
}

TEST(ShadingSorter, SendsRaysThatNeedNoMaterialOnAtOnce) {
  Bench bench(4, 4);
  EXPECT_EQ(bench.insert({0, kNoHit, 1, kNoHit}), (IdLists{{2, 4}}));
  EXPECT_EQ(bench.insert({0, 0}, RayKind::kShadow), (IdLists{{5, 6}}));
  EXPECT_EQ(bench.sorter.stats().num_bypassed, 4U);
  EXPECT_EQ(bench.sorter.stats().num_packets_bypassed, 2U);
  EXPECT_EQ(bench.sorter.stats().num_insertions, 2U);
}

TEST(ShadingSorter, ByTextureGathersMaterialsOfTheSameTextures) {
  Bench bench(4, 4, ShaderCacheKey::kTexture);
  EXPECT_EQ(bench.insert({2, 3, 0, 1}), IdLists{});
  EXPECT_EQ(bench.insert({3, 2}), (IdLists{{1, 2, 5, 6}}));
  EXPECT_EQ(bench.sweep(), (IdLists{{3, 4}}));
}

TEST(ShadingSorter, EvictsTheFullestCellAndOfEqualsTheFirstOpened) {
  Bench bench(4, 2);
  bench.insert({0, 1});
  EXPECT_EQ(bench.insert({2}), (IdLists{{1}}));
  bench.insert({2});
  EXPECT_EQ(bench.insert({3}), (IdLists{{3, 4}}));
  EXPECT_EQ(bench.sorter.stats().num_evictions, 2U);
  EXPECT_EQ(bench.sorter.stats().num_rays_evicted, 3U);
}

TEST(ShadingSorter, CountsMaterialsAndTexturesOfPacketsBeforeAndAfter) {
  Bench bench(4, 4);
  bench.insert({0, 1, 2, 3});
  bench.insert({0, 2, kNoHit, 0});
  bench.sweep();
  const ShaderCacheStats& stats = bench.sorter.stats();
  EXPECT_EQ(stats.sum_materials_in, 6U);   // 4, then 2
  EXPECT_EQ(stats.sum_materials_out, 4U);  // one a cell
  EXPECT_EQ(stats.sum_textures_in, 2U);    // one each; untextured counts none
  EXPECT_EQ(stats.sum_textures_out, 2U);   // those of materials 2 and 3
  EXPECT_EQ(stats.num_hits, 3U);
  EXPECT_EQ(stats.num_misses, 4U);
  EXPECT_EQ(stats.num_packets_swept, 4U);
  EXPECT_EQ(stats.num_rays_swept, 7U);
}

}  // namespace
}  // namespace sheaf
