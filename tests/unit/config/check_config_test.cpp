// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/check_config.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/errors.h"
#include "config/parameters.h"

namespace sheaf {
namespace {

/// What check_config says to the defaults with one change; empty if it accepts them.
std::string verdict(const std::function<void(Config&)>& change) {
  Config config;
  static_cast<void>(declare_parameters(config));
  change(config);
  try {
    check_config(config);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
}

TEST(CheckConfig, LinesArePowersOfTwo) {
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.line = 48; }),
            "node_cache.line = 48B must be a power of two");
  EXPECT_EQ(verdict([](Config& c) { c.l2.line = 96; }), "l2.line = 96B must be a power of two");
}

TEST(CheckConfig, CapacityHoldsWholeSets) {
  EXPECT_EQ(verdict([](Config& c) { c.texture_cache.capacity = 1000; }),
            "texture_cache.capacity = 1000B must be a multiple of line x ways = 256B");
  EXPECT_EQ(verdict([](Config& c) { c.l2.capacity = 1024; }),
            "l2.capacity = 1KiB must be a multiple of line x ways x banks = 2KiB");
}

TEST(CheckConfig, SetsAreAPowerOfTwo) {
  EXPECT_EQ(
      verdict([](Config& c) { c.film_cache.capacity = 768; }),
      "film_cache.capacity = 768B over line x ways = 256B makes 3 sets, which must be a power "
      "of two");
  EXPECT_EQ(verdict([](Config& c) {
              c.film_cache.ways = 3;
              c.film_cache.capacity = 3072;
            }),
            "");
}

TEST(CheckConfig, FullyAssociativeIsOneSet) {
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.ways = 256; }), "");
}

TEST(CheckConfig, PrivateLinesFitIntoALineOfTheL2) {
  EXPECT_EQ(verdict([](Config& c) { c.attribute_cache.line = 128; }),
            "attribute_cache.line = 128B must not be larger than l2.line = 64B");
  EXPECT_EQ(verdict([](Config& c) {
              c.attribute_cache.line = 128;
              c.l2.mode = CacheMode::kAbsent;
            }),
            "");
}

TEST(CheckConfig, BanksAreAPowerOfTwo) {
  EXPECT_EQ(verdict([](Config& c) { c.l2.banks = 3; }), "l2.banks = 3 must be a power of two");
}

TEST(CheckConfig, GeometryOfACacheThatIsNotBuiltDoesNotMatter) {
  EXPECT_EQ(verdict([](Config& c) {
              c.triangle_cache.mode = CacheMode::kPerfect;
              c.triangle_cache.line = 48;
              c.l2.mode = CacheMode::kPerfect;
              c.l2.banks = 3;
            }),
            "");
}

TEST(CheckConfig, SectorsDivideALineIntoPartsThatAreNotTooSmall) {
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.sectors = 3; }),
            "node_cache.sectors = 3 must be a power of two");
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.sectors = 8; }),
            "node_cache.sectors = 8 makes sectors of 8B of a line of 64B; at least 16B are needed");
  EXPECT_EQ(verdict([](Config& c) { c.l2.sectors = 2; }),
            "node_cache.line / sectors = 64B must not be larger than l2.line / sectors = 32B");
  EXPECT_EQ(verdict([](Config& c) { c.texture_cache.sectors = 4; }), "");
}

TEST(CheckConfig, ATreeOfBitsNeedsAPowerOfTwoOfWays) {
  const auto with_ways = [](std::uint32_t ways) {
    return verdict([ways](Config& c) {
      c.node_cache.replacement = Replacement::kPlru;
      c.node_cache.ways = ways;
      c.node_cache.capacity = Bytes{64} * ways;
    });
  };
  EXPECT_EQ(with_ways(3),
            "node_cache.ways = 3 must be a power of two up to 64 with replacement = plru");
  EXPECT_EQ(with_ways(128),
            "node_cache.ways = 128 must be a power of two up to 64 with replacement = plru");
  EXPECT_EQ(with_ways(64), "");
}

TEST(CheckConfig, BanksOfAPrivateCacheAreAPowerOfTwo) {
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.banks = 6; }),
            "node_cache.banks = 6 must be a power of two");
}

TEST(CheckConfig, SetsMakeTheCapacity) {
  Config config;
  static_cast<void>(declare_parameters(config));
  config.node_cache.sets = 32;
  config.l2.sets = 128;
  derive_capacities(config);
  EXPECT_EQ(config.node_cache.capacity, 32U * 64 * 4);
  EXPECT_EQ(config.l2.capacity, 128U * 64 * 8 * 4);
  EXPECT_EQ(verdict([](Config& c) { c.node_cache.sets = 33; }),
            "node_cache.sets = 33 must be a power of two");
}

TEST(CheckConfig, OnlyACrossbarWithAWidthHasADepth) {
  EXPECT_EQ(verdict([](Config& c) { c.crossbar.depth = 4; }),
            "crossbar.depth = 4 needs a crossbar.request_width; without one nothing waits");
}

TEST(CheckConfig, APacketFitsIntoATile) {
  EXPECT_EQ(verdict([](Config& c) { c.flow.tile_size = 3; }),
            "flow.tile_size = 3 makes tiles of 9 pixels, fewer than packet.size = 16");
  EXPECT_EQ(verdict([](Config& c) { c.flow.tile_size = 4; }), "");
}

TEST(CheckConfig, CreditsAdmitAPacket) {
  const auto with_credits = [](std::uint32_t credits) {
    return verdict([credits](Config& c) {
      c.flow.control = FlowPolicy::kCredits;
      c.flow.credits = credits;
    });
  };
  EXPECT_EQ(with_credits(15), "flow.credits = 15 admits no packet of packet.size = 16 rays");
  EXPECT_EQ(with_credits(16), "");
  EXPECT_EQ(with_credits(0), "");
}

TEST(CheckConfig, TheCameraNeedsADirection) {
  EXPECT_NE(verdict([](Config& c) { c.camera.position = c.camera.look_at = Triple{1, 2, 3}; }), "");
  EXPECT_EQ(verdict([](Config& c) { c.camera.look_at = Triple{1, 2, 3}; }), "");
}

TEST(CheckConfig, AnIntensityNeedsALight) {
  EXPECT_NE(verdict([](Config& c) { c.light.intensity = 1; }), "");
  EXPECT_EQ(verdict([](Config& c) {
              c.light.intensity = 1;
              c.light.position = Triple{};
            }),
            "");
}

TEST(CheckConfig, HeatMapsAreKnownCountersNamedOnce) {
  ImageSpec image;
  image.heat_maps = "rays, triangle_tests,";
  EXPECT_EQ(heat_map_names(image), (std::vector<std::string>{"rays", "triangle_tests"}));
  EXPECT_EQ(verdict([](Config& c) { c.image.heat_maps = "rays,heat"; }),
            "image.heat_maps: unknown counter 'heat'; known: rays, node_visits, triangle_tests");
  EXPECT_EQ(verdict([](Config& c) { c.image.heat_maps = "rays,rays"; }),
            "image.heat_maps: 'rays' stands there twice");
}

}  // namespace
}  // namespace sheaf
