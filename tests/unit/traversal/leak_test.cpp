// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// No ray slips through a closed mesh, however well it aims at edges and corners.
#include <gtest/gtest.h>

#include <cmath>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

/// Sends packets of rays from `origin` at points on corners and edges of the mesh. Each ray must
/// meet the mesh at its target: a ray that leaks meets the other side, or nothing.
void expect_no_leak(const TestScene& scene, const Vec3& origin, int rays, Random& random) {
  const auto aim = [&] {
    const auto& t = scene.mesh.triangles[random.below(scene.mesh.triangles.size())];
    const Vec3& a = scene.mesh.positions[t[random.below(3)]];
    const Vec3& b = scene.mesh.positions[t[random.below(3)]];  // a itself, one time in three
    return a + random.uniform() * (b - a);
  };
  std::array<float, 16> distance{};
  for (int i = 0; i < rays; i += 16) {
    RayPacket packet;
    packet.clear(16);
    for (int lane = 0; lane < 16; ++lane) {
      const Vec3 to = aim() - origin;
      distance[static_cast<std::size_t>(lane)] = glm::length(to);
      packet.put(lane, make_ray(origin, glm::normalize(to)));
    }
    for (const auto scheme : kTraversalSchemes) {
      TraceCounts counts;
      trace_packet(scheme, scene.tree, scene.records, packet, nullptr, nullptr, counts);
      for (std::size_t lane = 0; lane < 16; ++lane) {
        ASSERT_NE(packet.hit_triangle[lane], kNoHit) << "a ray got out";
        ASSERT_NEAR(packet.hit_t[lane], distance[lane], 1e-3F * distance[lane]);
      }
    }
  }
}

TEST(Leak, NoneFromInsideThroughEdgesAndCorners) {
  const TestScene scene(bumpy_sphere(40, 60, 0.02F));
  Random random(31);
  for (int i = 0; i < 20; ++i) {
    expect_no_leak(scene, 0.3F * random_direction(random), 5000, random);
  }
}

TEST(Leak, NoneThroughCornersOnSplitPlanes) {
  // A cube of many squares whose corners all lie on grid planes, seen from grid points: rays run
  // along planes, through edges and corners, with zeros among their directions.
  Mesh mesh;
  constexpr int kCells = 8;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      for (const int side : {0, kCells}) {
        for (int axis = 0; axis < 3; ++axis) {
          Vec3 at(0.0F);
          Vec3 u(0.0F);
          Vec3 v(0.0F);
          at[axis] = static_cast<float>(side);
          at[(axis + 1) % 3] = static_cast<float>(i);
          at[(axis + 2) % 3] = static_cast<float>(j);
          u[(axis + 1) % 3] = 1.0F;
          v[(axis + 2) % 3] = 1.0F;
          mesh.add_quad(at, u, v);
        }
      }
    }
  }
  const TestScene scene(mesh);
  Random random(32);
  for (int i = 0; i < 20; ++i) {
    const auto inside = [&] { return static_cast<float>(1 + random.below(kCells - 1)); };
    const float x = inside();
    const float y = inside();
    expect_no_leak(scene, Vec3(x, y, inside()), 2000, random);
  }
}

TEST(Leak, NoneInScenesThatAreScaledAndFarAway) {
  for (const float scale : {1e-6F, 1.0F, 1e6F}) {
    for (const float offset : {0.0F, 1e4F}) {
      Mesh mesh = bumpy_sphere(30, 40, 0.0F);
      // An offset much larger than the mesh would round its corners together: 1e4 leaves 10 bits.
      mesh.transform(scale, Vec3(scale * offset, -scale * offset, scale * offset));
      const TestScene scene(mesh);
      Random random(33);
      const Vec3 centre = 0.5F * (scene.tree.bounds.lo + scene.tree.bounds.hi);
      expect_no_leak(scene, centre, 2000, random);
    }
  }
}

TEST(Leak, NoneWithNeedles) {
  // 4 rings of 5000 sectors: triangles about 600 times as long as wide, more at the poles.
  const TestScene scene(bumpy_sphere(4, 5000, 0.0F));
  Random random(34);
  for (int i = 0; i < 5; ++i) {
    const Vec3 origin = 0.2F * random_direction(random);
    expect_no_leak(scene, origin, 2000, random);
  }
}

}  // namespace
}  // namespace sheaf::test
