// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/split_search.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "kdtree/small_node.h"
#include "kdtree/split_event.h"

namespace sheaf::test {
namespace {

const Box kCell{Vec3(-1.0F, 0.0F, 2.0F), Vec3(3.0F, 2.0F, 5.0F)};

// Boxes inside the cell on a coarse lattice, so that faces coincide, some of them planar, some in
// the cell's own faces.
std::vector<Box> lattice_boxes(Random& random, std::size_t count) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (int k = 0; k < 3; ++k) {
      const float step = kCell.extent()[k] / 16.0F;
      const auto a = static_cast<float>(random.below(17));
      const auto b = random.below(4) == 0 ? a : static_cast<float>(random.below(17));
      box.lo[k] = kCell.lo[k] + step * std::min(a, b);
      box.hi[k] = kCell.lo[k] + step * std::max(a, b);
    }
  }
  return boxes;
}

double split_cost(const std::vector<Box>& boxes, const SplitPlane& plane, const SahCosts& costs) {
  double num_left = 0.0;
  double num_right = 0.0;
  for (const Box& box : boxes) {
    const bool below = box.lo[plane.axis] < plane.position;
    const bool above = box.hi[plane.axis] > plane.position;
    num_left += below || (!above && plane.planar_left) ? 1.0 : 0.0;
    num_right += above || (!below && !plane.planar_left) ? 1.0 : 0.0;
  }
  Box left = kCell;
  Box right = kCell;
  left.hi[plane.axis] = plane.position;
  right.lo[plane.axis] = plane.position;
  const double cost =
      costs.traversal + costs.intersection *
                            (half_area(left) * num_left + half_area(right) * num_right) /
                            half_area(kCell);
  return num_left == 0.0 || num_right == 0.0 ? cost * costs.empty_bonus : cost;
}

// The least cost of all planes, tried one by one.
double least_cost(const std::vector<Box>& boxes, const SahCosts& costs) {
  double least = costs.intersection * static_cast<double>(boxes.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const Box& box : boxes) {
      for (const float x : {box.lo[axis], box.hi[axis]}) {
        if (x <= kCell.lo[axis] || x >= kCell.hi[axis]) continue;
        for (const bool planar_left : {false, true}) {
          least = std::min(least, split_cost(boxes, {axis, x, planar_left}, costs));
        }
      }
    }
  }
  return least;
}

SplitPlane sweep(const std::vector<Box>& boxes, const SahCosts& costs) {
  std::array<std::vector<SplitEvent>, 3> lists;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      auto& list = lists[static_cast<std::size_t>(k)];
      if (boxes[i].lo[k] == boxes[i].hi[k]) {
        list.push_back(make_event(boxes[i].lo[k], EventKind::kPlanar, i));
      } else {
        list.push_back(make_event(boxes[i].lo[k], EventKind::kStart, i));
        list.push_back(make_event(boxes[i].hi[k], EventKind::kEnd, i));
      }
    }
  }
  NodeEvents events;
  events.num_triangles = boxes.size();
  for (std::size_t k = 0; k < 3; ++k) {
    std::sort(lists[k].begin(), lists[k].end());
    events.axis[k] = lists[k];
  }
  return find_split(events, kCell, costs);
}

SmallNode small_node(const std::vector<Box>& boxes) {
  SmallNode node;
  for (const Box& box : boxes) {
    for (int k = 0; k < 3; ++k) {
      node.lo[static_cast<std::size_t>(k)][node.count] = box.lo[k];
      node.hi[static_cast<std::size_t>(k)][node.count] = box.hi[k];
    }
    node.triangle[node.count] = static_cast<std::uint32_t>(node.count);
    ++node.count;
  }
  return node;
}

void expect_cheapest(const SplitPlane& plane, const std::vector<Box>& boxes, const SahCosts& costs,
                     double tolerance) {
  const double leaf_cost = costs.intersection * static_cast<double>(boxes.size());
  const double least = least_cost(boxes, costs);
  const double found = plane.found() ? split_cost(boxes, plane, costs) : leaf_cost;
  EXPECT_NEAR(found, least, tolerance * least) << boxes.size() << " boxes";
}

TEST(SplitSearch, SweepFindsTheCheapestPlane) {
  Random random(31);
  for (const double bonus : {0.8, 1.0}) {
    for (std::size_t i = 0; i < 500; ++i) {
      const auto boxes = lattice_boxes(random, i % 60);
      const SahCosts costs{15.0, i % 3 == 0 ? 80.0 : 20.0, bonus};
      expect_cheapest(sweep(boxes, costs), boxes, costs, 1e-12);
    }
  }
}

TEST(SplitSearch, CountingFindsTheCheapestPlane) {
  Random random(32);
  for (const double bonus : {0.8, 1.0}) {
    for (std::size_t i = 0; i < 500; ++i) {
      const auto boxes = lattice_boxes(random, i % (SmallNode::kCapacity + 1));
      const SahCosts costs{15.0, i % 3 == 0 ? 80.0 : 20.0, bonus};
      expect_cheapest(find_split(small_node(boxes), kCell, costs), boxes, costs, 1e-6);
    }
  }
}

TEST(SplitSearch, EveryInstructionSetFindsTheSamePlane) {
  std::vector<std::vector<Box>> cases;
  Random random(33);
  for (std::size_t i = 0; i < 400; ++i) {
    cases.push_back(lattice_boxes(random, i % (SmallNode::kCapacity + 1)));
  }
  std::vector<SplitPlane> expected;
  for (const auto& boxes : cases) expected.push_back(find_split(small_node(boxes), kCell, {}));
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const SplitPlane plane = find_split(small_node(cases[i]), kCell, {});
      EXPECT_EQ(plane.axis, expected[i].axis) << hwy::TargetName(target);
      EXPECT_EQ(plane.position, expected[i].position) << hwy::TargetName(target);
      EXPECT_EQ(plane.planar_left, expected[i].planar_left) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(SplitSearch, CellWithoutAreaIsNotSplit) {
  const Box line{Vec3(0.0F), Vec3(4.0F, 0.0F, 0.0F)};
  const std::vector<Box> boxes(3, Box{Vec3(1.0F, 0.0F, 0.0F), Vec3(2.0F, 0.0F, 0.0F)});
  EXPECT_FALSE(find_split(small_node(boxes), line, {}).found());
}

}  // namespace
}  // namespace sheaf::test
