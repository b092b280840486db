// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/tile_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

namespace sheaf {
namespace {

struct Shape {
  std::uint32_t width, height, tile;
  int run;
};

void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.width << " x " << shape.height << ", tiles of " << shape.tile << ", runs of "
       << shape.run;
}

/// All runs of a picture, tile by tile.
std::vector<TileOrder::Run> runs_of(const Shape& shape) {
  TileOrder order(shape.width, shape.height, shape.tile, shape.run);
  std::vector<TileOrder::Run> runs;
  for (; !order.is_done(); order.next_tile()) {
    TileOrder::Run run;
    while (order.next_run(run)) runs.push_back(run);
  }
  TileOrder::Run none;
  EXPECT_FALSE(order.next_run(none));
  return runs;
}

class TileOrderShape : public testing::TestWithParam<Shape> {};

TEST_P(TileOrderShape, MeetsEveryPixelOnceInTilesRowByRow) {
  const Shape& shape = GetParam();
  std::vector<int> met(shape.width * shape.height, 0);
  const std::uint32_t across = (shape.width + shape.tile - 1) / shape.tile;
  std::uint32_t last_tile = 0;
  for (const TileOrder::Run& run : runs_of(shape)) {
    EXPECT_GE(run.tile, last_tile);
    last_tile = run.tile;
    int lanes = 0;
    for (int lane = 0; lane < shape.run; ++lane) {
      const std::uint32_t pixel = run.pixels[static_cast<std::size_t>(lane)];
      if (pixel == TileOrder::kNoPixel) continue;
      ++lanes;
      ASSERT_LT(pixel, met.size());
      ++met[pixel];
      const std::uint32_t column = pixel % shape.width / shape.tile;
      const std::uint32_t row = pixel / shape.width / shape.tile;
      EXPECT_EQ(run.tile, row * across + column);
    }
    EXPECT_GT(lanes, 0) << "a run without pixels";
  }
  EXPECT_EQ(std::count(met.begin(), met.end(), 1), std::ssize(met));
}

INSTANTIATE_TEST_SUITE_P(Shapes, TileOrderShape,
                         testing::Values(Shape{1, 1, 16, 16}, Shape{33, 17, 16, 16},
                                         Shape{37, 23, 5, 7}, Shape{7, 50, 1, 64},
                                         Shape{20, 11, 64, 3}, Shape{13, 9, 6, 1},
                                         Shape{64, 32, 12, 64}));

TEST(TileOrder, VisitsOnlyTheTilesThatAreChosen) {
  TileOrder all(32, 32, 16, 16);
  TileOrder chosen(32, 32, 16, 16, {1, 3});
  EXPECT_EQ(chosen.num_tiles(), 2U);
  TileOrder::Run expected;
  TileOrder::Run run;
  for (const std::uint32_t tile : {1U, 3U}) {
    EXPECT_EQ(chosen.tile(), tile);
    EXPECT_EQ(chosen.is_last(), tile == 3);
    while (all.tile() != tile) all.next_tile();
    while (all.next_run(expected)) {
      ASSERT_TRUE(chosen.next_run(run));
      EXPECT_EQ(run.pixels, expected.pixels);
      EXPECT_EQ(run.tile, tile);
    }
    EXPECT_FALSE(chosen.next_run(run));
    chosen.next_tile();
  }
  EXPECT_TRUE(chosen.is_done());
}

TEST(TileOrder, MakesRunsOfSixteenFourByFourBlocks) {
  for (const TileOrder::Run& run : runs_of({48, 32, 16, 16})) {
    const std::uint32_t corner = run.pixels[0];
    EXPECT_EQ(corner % 48 % 4, 0U);
    EXPECT_EQ(corner / 48 % 4, 0U);
    std::vector<std::uint32_t> block;
    for (std::uint32_t y = 0; y < 4; ++y) {
      for (std::uint32_t x = 0; x < 4; ++x) block.push_back(corner + y * 48 + x);
    }
    std::vector<std::uint32_t> pixels(run.pixels.begin(), run.pixels.begin() + 16);
    std::sort(pixels.begin(), pixels.end());
    EXPECT_EQ(pixels, block);
  }
}

}  // namespace
}  // namespace sheaf
