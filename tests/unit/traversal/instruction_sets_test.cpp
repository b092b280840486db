// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <vector>

#include "test_mesh.h"

namespace sheaf::test {
namespace {

/// Everything that a set of packets leaves behind, in bits.
std::vector<std::uint32_t> trace_all(const TestScene& scene, TraversalScheme scheme) {
  std::vector<std::uint32_t> out;
  Random random(51);
  for (const int size : {1, 3, 4, 8, 12, 16, 17, 32, 64}) {
    for (int i = 0; i < 20; ++i) {
      RayPacket packet;
      packet.clear(size);
      const Ray base = random_ray(random, scene.tree.bounds);
      for (int lane = 0; lane < size; ++lane) {
        Ray ray = random_ray(random, scene.tree.bounds);
        if (i % 2 == 0) ray.direction = glm::normalize(base.direction + 0.2F * ray.direction);
        if (lane % 5 == 4) ray.tag.kind = RayKind::kShadow;
        // Aim some at corners, where doubles must decide.
        if (lane % 3 == 2) {
          const auto& record = scene.records[random.below(scene.records.size())];
          ray.direction = glm::normalize(record.b - ray.origin);
        }
        packet.put(lane, ray);
      }
      TraceCounts counts;
      TraceLog log;
      trace_packet(scheme, scene.tree, scene.records, packet, &log, nullptr, counts);
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(size); ++lane) {
        out.push_back(packet.hit_triangle[lane]);
        out.push_back(std::bit_cast<std::uint32_t>(packet.hit_t[lane]));
        out.push_back(std::bit_cast<std::uint32_t>(packet.hit_u[lane]));
        out.push_back(std::bit_cast<std::uint32_t>(packet.hit_v[lane]));
      }
      for (const TraceStep& step : log) out.insert(out.end(), {step.node, step.num_tests});
      out.push_back(static_cast<std::uint32_t>(counts.lane_triangle_tests));
      out.push_back(static_cast<std::uint32_t>(counts.lane_inner_visits));
    }
  }
  return out;
}

TEST(InstructionSets, AllGiveBitIdenticalHitsAndLogs) {
  const TestScene soup_scene(soup(1500, 0.12F, 52));
  const TestScene lattice_scene(lattice(4));
  for (const TestScene* scene : {&soup_scene, &lattice_scene}) {
    std::vector<std::vector<std::uint32_t>> best;
    for (const auto scheme : kTraversalSchemes) best.push_back(trace_all(*scene, scheme));
    const std::int64_t supported = hwy::SupportedTargets();
    for (std::int64_t left = supported; left != 0; left &= left - 1) {
      // Lower bits are better targets: leave this one and those below it.
      const std::int64_t target = left & -left;
      hwy::SetSupportedTargetsForTest(supported & ~(target - 1));
      for (std::size_t i = 0; i < kTraversalSchemes.size(); ++i) {
        EXPECT_EQ(trace_all(*scene, kTraversalSchemes[i]), best[i])
            << "target " << hwy::TargetName(target) << ", scheme " << i;
      }
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace
}  // namespace sheaf::test
