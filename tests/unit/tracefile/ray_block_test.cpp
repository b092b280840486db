// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/ray_block.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "base/random.h"
#include "tracefile/columns.h"

namespace sheaf {
namespace {

const BlockGrid kGrid(40, 20);  // three blocks by two, the outer ones cut off

RayBlock some_block(std::uint64_t number) {
  Random random(number);
  RayBlock block;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const std::uint32_t pixel = kGrid.pixel_at(number, static_cast<std::uint8_t>(i % 4));
    const bool primary = i < 4;
    ShadedRay ray;
    ray.tag = {primary ? primary_ray_id(pixel) : random.next(), pixel,
               static_cast<std::uint8_t>(primary ? 0 : 1 + random.below(100)),
               primary ? RayKind::kPrimary : RayKind::kRefraction};
    ray.packet = random.below(1000);
    ray.hit = random.below(2) != 0;
    ray.contributes = random.below(2) != 0;
    ray.first_child = static_cast<std::uint32_t>(block.children.size());
    ray.num_children = static_cast<std::uint32_t>(random.below(4));
    for (std::uint32_t c = 0; c < ray.num_children; ++c) {
      const auto f = [&] { return random.uniform() - 0.5F; };
      block.children.push_back({c * 1000,
                                {f(), f(), f()},
                                std::numeric_limits<float>::infinity(),
                                {f(), -0.0F, f()},
                                {f(), f(), f()}});
    }
    block.rays.push_back(ray);
  }
  return block;
}

TEST(RayBlock, GivesBackWhatWasWritten) {
  const RayBlock block = some_block(5);
  ByteVector raw;
  encode_ray_block(block, kGrid, raw);
  RayBlock read;
  decode_ray_block(raw, 5, static_cast<std::uint32_t>(block.rays.size()), kGrid, read);
  ASSERT_EQ(read.rays.size(), block.rays.size());
  for (std::size_t i = 0; i < read.rays.size(); ++i) {
    EXPECT_EQ(read.rays[i].tag.id, block.rays[i].tag.id);
    EXPECT_EQ(read.rays[i].tag.pixel, block.rays[i].tag.pixel);
    EXPECT_EQ(read.rays[i].tag.depth, block.rays[i].tag.depth);
    EXPECT_EQ(read.rays[i].tag.kind, block.rays[i].tag.kind);
    EXPECT_EQ(read.rays[i].packet, block.rays[i].packet);
    EXPECT_EQ(read.rays[i].hit, block.rays[i].hit);
    EXPECT_EQ(read.rays[i].contributes, block.rays[i].contributes);
    EXPECT_EQ(read.rays[i].first_child, block.rays[i].first_child);
    EXPECT_EQ(read.rays[i].num_children, block.rays[i].num_children);
  }
  ASSERT_EQ(read.children.size(), block.children.size());
  EXPECT_EQ(std::memcmp(read.children.data(), block.children.data(),
                        read.children.size() * sizeof(SpawnedRay)),
            0);
}

TEST(RayBlock, InPartsIsTheWhole) {
  const RayBlock block = some_block(5);
  ByteVector raw;
  encode_ray_block(block, kGrid, raw);
  RayBlock twice;
  const auto count = static_cast<std::uint32_t>(block.rays.size());
  decode_ray_block(raw, 5, count, kGrid, twice);
  decode_ray_block(raw, 5, count, kGrid, twice);
  ASSERT_EQ(twice.rays.size(), 2 * block.rays.size());
  EXPECT_EQ(twice.rays[count].first_child, block.children.size());
  EXPECT_EQ(twice.children.size(), 2 * block.children.size());
}

// The content of a frame can be anything, if somebody has computed its checksums.
TEST(RayBlock, OfAnyBytesIsRefusedOrSound) {
  const RayBlock block = some_block(5);
  ByteVector raw;
  encode_ray_block(block, kGrid, raw);
  Random random(7);
  int refused = 0;
  for (int round = 0; round < 20000; ++round) {
    ByteVector damaged = raw;
    damaged[random.below(damaged.size())] = static_cast<std::uint8_t>(random.next());
    if (round % 4 == 0) damaged.resize(random.below(damaged.size()));
    const auto count = static_cast<std::uint32_t>(round % 8 == 1   ? random.below(100)
                                                  : round % 8 == 2 ? random.next()
                                                                   : block.rays.size());
    RayBlock read;
    try {
      decode_ray_block(damaged, 5, count, kGrid, read);
    } catch (const BadColumn&) {
      ++refused;
      continue;
    }
    for (const ShadedRay& ray : read.rays) {
      ASSERT_EQ(kGrid.block_of(ray.tag.pixel), 5U);
      ASSERT_LT(ray.tag.pixel, 800U);
      ASSERT_LE(ray.first_child + ray.num_children, read.children.size());
    }
  }
  EXPECT_GT(refused, 5000);
}

TEST(BlockGrid, CutsThePictureIntoSquares) {
  EXPECT_EQ(kGrid.num_blocks(), 6U);
  EXPECT_EQ(kGrid.num_pixels_in(0), 256U);
  EXPECT_EQ(kGrid.num_pixels_in(2), 8U * 16U);
  EXPECT_EQ(kGrid.num_pixels_in(5), 8U * 4U);
  for (std::uint32_t pixel = 0; pixel < 800; ++pixel) {
    EXPECT_EQ(kGrid.pixel_at(kGrid.block_of(pixel), kGrid.position_of(pixel)), pixel);
  }
  EXPECT_EQ(kGrid.pixel_at(5, 255), 800U);  // outside
}

}  // namespace
}  // namespace sheaf
