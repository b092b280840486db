// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/memory_map.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace sheaf::test {
namespace {

constexpr std::array kKinds{DataKind::kNode,      DataKind::kLeafList, DataKind::kTriangle,
                            DataKind::kAttribute, DataKind::kTexture,  DataKind::kPixel,
                            DataKind::kSpilledRay};

MemoryCounts some_counts() {
  return {.nodes = 1001,
          .leaf_entries = 513,
          .triangles = 77,
          .vertices = 101,
          .materials = 3,
          .textures = {{5, 9}, {64, 64}},
          .pixels = 640 * 480,
          .bytes_per_pixel = 12};
}

TEST(DataKind, NamesAreDistinct) {
  static_assert(kKinds.size() == kNumDataKinds);
  std::set<std::string_view> names;
  for (const DataKind kind : kKinds) names.insert(to_string(kind));
  EXPECT_EQ(names.size(), kKinds.size());
  EXPECT_EQ(to_string(DataKind::kLeafList), "leaf_list");
}

TEST(MemoryMap, RegionsFollowEachOtherOnPages) {
  const MemoryMap map(some_counts());
  Address end = MemoryMap::kBase;
  for (const DataKind kind : kKinds) {
    const MemoryMap::Region& region = map.region(kind);
    EXPECT_EQ(region.base % MemoryMap::kPage, 0U);
    EXPECT_GE(region.base, end);
    EXPECT_LT(region.base - end, MemoryMap::kPage);
    end = region.base + region.size;
  }
}

TEST(MemoryMap, EndsWithTheFrameBufferAndSpilledRaysComeBehindIt) {
  const MemoryMap map(some_counts());
  const MemoryMap::Region& pixels = map.region(DataKind::kPixel);
  EXPECT_EQ(map.total_size(), pixels.base + pixels.size - MemoryMap::kBase);
  EXPECT_GE(map.region(DataKind::kSpilledRay).base, pixels.base + pixels.size);
  EXPECT_EQ(map.region(DataKind::kSpilledRay).size, 0U);
}

TEST(MemoryMap, RegionSizesAreThoseOfTheirRecords) {
  const MemoryMap map(some_counts());
  EXPECT_EQ(map.region(DataKind::kNode).size, 1001U * 8);
  EXPECT_EQ(map.region(DataKind::kLeafList).size, 513U * 4);
  EXPECT_EQ(map.region(DataKind::kTriangle).size, 77U * 48);
  EXPECT_EQ(map.region(DataKind::kAttribute).size, 102U * 32 + 3U * 64);  // 101 fill half a line
  EXPECT_EQ(map.region(DataKind::kTexture).size, (2U * 3 + 16U * 16) * 64);
  EXPECT_EQ(map.region(DataKind::kPixel).size, 640U * 480 * 12);
}

TEST(MemoryMap, LastRecordsEndInsideTheirRegions) {
  const MemoryMap map(some_counts());
  const auto end = [&](DataKind kind) { return map.region(kind).base + map.region(kind).size; };
  EXPECT_EQ(map.node(1000) + MemoryMap::kNodeSize, end(DataKind::kNode));
  EXPECT_EQ(map.leaf_entry(512) + MemoryMap::kLeafEntrySize, end(DataKind::kLeafList));
  EXPECT_EQ(map.triangle(76) + MemoryMap::kTriangleSize, end(DataKind::kTriangle));
  EXPECT_LE(map.vertex(100) + MemoryMap::kVertexSize, map.material(0));
  EXPECT_EQ(map.material(2) + MemoryMap::kMaterialSize, end(DataKind::kAttribute));
  EXPECT_EQ(map.texel(1, 63, 63) + MemoryMap::kTexelSize, end(DataKind::kTexture));
  EXPECT_EQ(map.pixel(640 * 480 - 1) + 12, end(DataKind::kPixel));
}

TEST(MemoryMap, FirstRecordsStandAtTheirRegions) {
  const MemoryMap map(some_counts());
  EXPECT_EQ(map.node(0), 0x1000'0000U);
  EXPECT_EQ(map.leaf_entry(0), map.region(DataKind::kLeafList).base);
  EXPECT_EQ(map.triangle(0), map.region(DataKind::kTriangle).base);
  EXPECT_EQ(map.vertex(0), map.region(DataKind::kAttribute).base);
  EXPECT_EQ(map.material(0) % 64, 0U);
  EXPECT_EQ(map.texel(0, 0, 0), map.region(DataKind::kTexture).base);
  EXPECT_EQ(map.pixel(0), map.region(DataKind::kPixel).base);
}

TEST(MemoryMap, TexelsStandInBlocksRowByRow) {
  const MemoryMap map(some_counts());
  const Address base = map.region(DataKind::kTexture).base;
  EXPECT_EQ(map.texel(0, 3, 0), base + 12);
  EXPECT_EQ(map.texel(0, 0, 1), base + 16);
  EXPECT_EQ(map.texel(0, 4, 0), base + 64);      // the second block of the row
  EXPECT_EQ(map.texel(0, 0, 4), base + 2 * 64);  // two blocks a row for 5 texels
  EXPECT_EQ(map.texel(1, 0, 0), base + 6 * 64);
}

TEST(MemoryMap, TexelsHaveAddressesOfTheirOwn) {
  const MemoryMap map(some_counts());
  std::set<Address> seen;
  for (std::uint32_t y = 0; y < 9; ++y) {
    for (std::uint32_t x = 0; x < 5; ++x) EXPECT_TRUE(seen.insert(map.texel(0, x, y)).second);
  }
  EXPECT_LT(*seen.rbegin(), map.texel(1, 0, 0));
}

TEST(MemoryMap, WhatIsNotNeededTakesNoRoom) {
  const MemoryMap map({.nodes = 1,
                       .leaf_entries = 0,
                       .triangles = 0,
                       .vertices = 0,
                       .materials = 0,
                       .textures = {},
                       .pixels = 10,
                       .bytes_per_pixel = 4});
  for (const DataKind kind :
       {DataKind::kLeafList, DataKind::kTriangle, DataKind::kAttribute, DataKind::kTexture}) {
    EXPECT_EQ(map.region(kind).size, 0U) << to_string(kind);
  }
  EXPECT_EQ(map.region(DataKind::kPixel).base, MemoryMap::kBase + MemoryMap::kPage);
}

}  // namespace
}  // namespace sheaf::test
