// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/watertight.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "base/random.h"

namespace sheaf {
namespace {

struct Triangle {
  Vec3 a, b, c;
};

bool hit(const Vec3& origin, const Vec3& direction, const Triangle& triangle, TriangleHit& out) {
  return hit_sheared(ShearedRay(origin, direction).shear(&triangle.a.x), out);
}
bool hit(const Vec3& origin, const Vec3& direction, const Triangle& triangle) {
  TriangleHit out;
  return hit(origin, direction, triangle, out);
}

Vec3 random_vector(Random& random) {
  const float x = random.uniform();
  const float y = random.uniform();
  return 2.0F * Vec3(x, y, random.uniform()) - Vec3(1.0F);
}

const Triangle kTriangle{Vec3(0.0F, 0.0F, 4.0F), Vec3(1.0F, 0.0F, 4.0F), Vec3(0.0F, 1.0F, 4.0F)};

TEST(Watertight, GivesDistanceAndWeightsFromBothSides) {
  TriangleHit out;
  ASSERT_TRUE(hit(Vec3(0.25F, 0.5F, 0.0F), Vec3(0.0F, 0.0F, 2.0F), kTriangle, out));
  EXPECT_EQ(out.t, 2.0F);
  EXPECT_EQ(out.u, 0.25F);
  EXPECT_EQ(out.v, 0.5F);
  ASSERT_TRUE(hit(Vec3(0.25F, 0.5F, 8.0F), Vec3(0.0F, 0.0F, -2.0F), kTriangle, out));
  EXPECT_EQ(out.t, 2.0F);
  EXPECT_EQ(out.u, 0.25F);
  EXPECT_EQ(out.v, 0.5F);
}

TEST(Watertight, EdgesAndCornersBelongToTheTriangle) {
  const Vec3 forward(0.0F, 0.0F, 1.0F);
  for (const Vec3& p : {Vec3(0.0F), Vec3(1.0F, 0.0F, 0.0F), Vec3(0.0F, 1.0F, 0.0F),
                        Vec3(0.5F, 0.0F, 0.0F), Vec3(0.0F, 0.5F, 0.0F), Vec3(0.5F, 0.5F, 0.0F)}) {
    EXPECT_TRUE(hit(p, forward, kTriangle)) << p.x << ' ' << p.y;
  }
  EXPECT_FALSE(hit(Vec3(-1e-30F, 0.5F, 0.0F), forward, kTriangle));
  EXPECT_FALSE(hit(Vec3(0.5F, -1e-30F, 0.0F), forward, kTriangle));
  EXPECT_FALSE(hit(Vec3(0.5F, std::nextafter(0.5F, 1.0F), 0.0F), forward, kTriangle));
}

TEST(Watertight, LongestAxisIsZAndTheOthersFollowCyclically) {
  const std::array<Vec3, 3> directions = {Vec3(3.0F, 1.0F, -2.0F), Vec3(1.0F, -3.0F, 2.0F),
                                          Vec3(1.0F, 2.0F, 3.0F)};
  for (std::size_t z = 0; z < 3; ++z) {
    const ShearedRay ray(Vec3(0.0F), directions[z]);
    EXPECT_EQ(ray.z, z);
    EXPECT_EQ(ray.x, (z + 1) % 3);
    EXPECT_EQ(ray.y, (z + 2) % 3);
  }
}

// Products of numbers this small vanish in single precision, and with them every edge function.
TEST(Watertight, TinyTrianglesAreDecidedInDoublePrecision) {
  const float s = 1e-25F;
  const Triangle tiny{s * kTriangle.a, s * kTriangle.b, s * kTriangle.c};
  TriangleHit out;
  ASSERT_TRUE(hit(Vec3(0.25F * s, 0.5F * s, 0.0F), Vec3(0.0F, 0.0F, 1.0F), tiny, out));
  EXPECT_FLOAT_EQ(out.t, 4.0F * s);
  EXPECT_FLOAT_EQ(out.u, 0.25F);
  EXPECT_FLOAT_EQ(out.v, 0.5F);
  EXPECT_FALSE(hit(Vec3(0.75F * s, 0.5F * s, 0.0F), Vec3(0.0F, 0.0F, 1.0F), tiny));
}

// The promise of the test: of two triangles with a common edge, a ray that crosses the
// quadrilateral hits at least one.
TEST(Watertight, NoRayPassesBetweenTwoTrianglesOfAnEdge) {
  Random random(61);
  int in_both = 0;
  for (int i = 0; i < 200000; ++i) {
    // Every other ray is computed without rounding, so that it meets the edge exactly.
    const bool exact = i % 2 == 0;
    const auto vector = [&] {
      const Vec3 v = random_vector(random);
      return exact ? glm::floor(256.0F * v) / 256.0F : v;
    };
    const Vec3 a = vector();
    const Vec3 b = vector();
    const Vec3 middle = 0.5F * (a + b);
    const Vec3 aside = 0.5F * vector();
    const Triangle left{a, b, middle + aside};
    const Triangle right{b, a, middle - aside};
    const Vec3 target = exact ? middle : a + (0.1F + 0.8F * random.uniform()) * (b - a);
    const Vec3 origin = exact ? target - Vec3(0.0F, 0.0F, 4.0F) : 3.0F * random_vector(random);
    const Vec3 direction = target - origin;
    // Seen edge-on the two triangles have no inside.
    const Vec3 normal = glm::cross(b - a, aside);
    if (std::abs(glm::dot(normal, direction)) <
        1e-2F * glm::length(normal) * glm::length(direction)) {
      continue;
    }
    const bool in_left = hit(origin, direction, left);
    const bool in_right = hit(origin, direction, right);
    ASSERT_TRUE(in_left || in_right) << "ray " << i;
    in_both += in_left && in_right ? 1 : 0;
  }
  EXPECT_GT(in_both, 50000) << "too few rays met the edge exactly";
}

TEST(Watertight, EqualCornersAreNeverHit) {
  Random random(62);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_vector(random);
    const Vec3 b = random_vector(random);
    const Vec3 origin = random_vector(random);
    const Vec3 direction = a + random.uniform() * (b - a) - origin;
    EXPECT_FALSE(hit(origin, direction, {a, a, b}));
    EXPECT_FALSE(hit(origin, direction, {a, b, b}));
    EXPECT_FALSE(hit(origin, direction, {b, a, b}));
    EXPECT_FALSE(hit(origin, direction, {a, a, a}));
  }
}

}  // namespace
}  // namespace sheaf
