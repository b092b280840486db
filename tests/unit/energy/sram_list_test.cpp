// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The default machine for scenes/dragon.glb, whose sizes the pages of rtl_notes/ give.

#include "energy/sram_list.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/read_config.h"

namespace sheaf {
namespace {

struct Machine {
  explicit Machine(const std::vector<std::string>& settings = {})
      : config(resolve_config({}, settings)) {
    plan.heuristic = HeuristicChoice::parse(config.ray_cache.heuristic);
    plan.shadow_rays = plan.reflection_rays = plan.secondary_rays = true;
    plan.ray_cache = plan.heuristic.kind != HeuristicChoice::Kind::kNone;
    stats.add("scene.lights", 1, "", "");
    stats.add("memory.footprint", 20'000'000, "bytes", "");
  }
  [[nodiscard]] MachineSizes sizes() const { return machine_sizes(config, plan, stats); }
  [[nodiscard]] std::vector<Sram> srams() const { return list_srams(config, plan, sizes()); }
  [[nodiscard]] const Sram* find(std::string_view name) {
    all = srams();
    const auto it = std::ranges::find(all, name, &Sram::name);
    return it == all.end() ? nullptr : &*it;
  }
  [[nodiscard]] std::uint64_t bits(std::string_view name) { return find(name)->bits.value(); }

  Config config;
  BuildPlan plan;
  StatsTree stats;
  std::vector<Sram> all;
};

TEST(SramList, WidthsAreThoseOfTheNotes) {
  const MachineSizes sizes = Machine().sizes();
  EXPECT_EQ(sizes.ray_bits, 343U);
  EXPECT_EQ(sizes.address_bits, 29U);
  EXPECT_EQ(sizes.rays_in_loop, 512U);
  EXPECT_EQ(sizes.spawned_per_ray, 2U);
  EXPECT_EQ(sizes.packets_in_store, 60U);
}

TEST(SramList, MemoriesAreThoseOfTheNotes) {
  Machine machine;
  EXPECT_EQ(machine.bits("prepared_rays"), 49'152U);
  EXPECT_EQ(machine.bits("traversal_stack"), 547'840U);
  EXPECT_EQ(machine.bits("node_cache"), 131'072U + 256 * 19);
  EXPECT_EQ(machine.bits("sheared_rays"), 14'464U);
  EXPECT_EQ(machine.bits("leaf_lists"), 2'048U);
  EXPECT_EQ(machine.bits("fetched_attributes"), 81'920U);
  EXPECT_EQ(machine.bits("spawned_bundles"), 43'904U);
  EXPECT_EQ(machine.bits("ray_cache"), 43'904U);
  EXPECT_EQ(machine.bits("spawned_rays"), 175'616U);
  EXPECT_EQ(machine.bits("l2"), 4 * (1'048'576U + 2'048 * 15));
  EXPECT_EQ(machine.bits("packet_store"), 60U * 16 * (343 + 128));
  EXPECT_EQ(machine.find("node_cache")->count, 2U);
  EXPECT_EQ(machine.find("film_cache")->count, 1U);
}

TEST(SramList, WhatIsNotBuiltHasNoSram) {
  EXPECT_EQ(Machine({"ray_cache.heuristic=none"}).find("ray_cache"), nullptr);
  EXPECT_EQ(Machine().find("texture_cache"), nullptr);
  EXPECT_EQ(Machine().find("shader_cache"), nullptr);
  EXPECT_EQ(Machine({"node_cache.mode=absent"}).find("node_cache"), nullptr);
  EXPECT_EQ(Machine({"l2.mode=absent"}).find("l2"), nullptr);
}

TEST(SramList, WhatHasNoBoundThatCouldBeBuiltIsUnknown) {
  EXPECT_FALSE(Machine({"ray_cache.heuristic=opos"}).find("ray_cache")->bits);
  EXPECT_FALSE(Machine({"ray_cache.order=breadth_first"}).find("ray_cache")->bits);
  EXPECT_FALSE(Machine({"node_cache.mode=perfect"}).find("node_cache")->bits);
  Machine deep({"render.recursion_level=100"});
  deep.plan.refraction_rays = true;
  EXPECT_FALSE(deep.find("spawned_rays")->bits);
}

TEST(SramList, CellsFollowHeuristicAndSetting) {
  const std::uint64_t cell = 16 * 343;
  EXPECT_EQ(Machine({"ray_cache.heuristic=mdir(96)"}).bits("ray_cache"), 96 * cell);
  EXPECT_EQ(Machine({"ray_cache.heuristic=mdir(96)", "ray_cache.cells=5"}).bits("ray_cache"),
            5 * cell);
  EXPECT_EQ(Machine({"ray_cache.heuristic=pos(1)"}).bits("ray_cache"), 64 * (cell + 96));
}

// Valid and dirty bits by sector; banks change the energy of an access, not the size.
TEST(SramList, SectorsAddBitsAndBanksMakeAccessesCheaper) {
  EXPECT_EQ(Machine({"node_cache.sectors=4"}).bits("node_cache"), 131'072U + 256 * (19 + 6));
  Machine whole;
  Machine banked({"node_cache.banks=4"});
  EXPECT_EQ(banked.bits("node_cache"), whole.bits("node_cache"));
  EXPECT_DOUBLE_EQ(banked.find("node_cache")->word_picojoule().value() * 2,
                   whole.find("node_cache")->word_picojoule().value());
}

TEST(SramList, CreditsBoundTheQueue) {
  Machine machine({"flow.control=credits", "flow.credits=100"});
  EXPECT_EQ(machine.bits("spawned_rays"), 100U * 343);
  EXPECT_EQ(Machine({"flow.control=spill", "flow.spill_queue=30"}).bits("spawned_rays"), 30U * 343);
}

}  // namespace
}  // namespace sheaf
