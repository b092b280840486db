// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/energy_report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/read_config.h"
#include "energy/operations.h"

namespace sheaf {
namespace {

/// A run of a machine without SRAM of its own in the way: counters are given, energies come back.
class Report {
 public:
  explicit Report(const std::vector<std::string>& settings = {})
      : config_(resolve_config({}, settings)) {
    plan_.heuristic = HeuristicChoice::parse(config_.ray_cache.heuristic);
    give("scene.lights", 0);
    give("memory.footprint", 4096);
    give("rays.num_retired", 10);
    give("rays.num_spawned", 10);
    give("rays.num_hits", 4);
  }
  void give(const std::string& path, std::uint64_t value) { stats_.add(path, value, "", ""); }
  void take(double seconds) { stats_.add_real("system.seconds", seconds, "s", ""); }
  void run() { report_energy(config_, plan_, stats_); }

  [[nodiscard]] bool has(const std::string& path) const { return stats_.find(path) != nullptr; }
  [[nodiscard]] bool is_unknown(const std::string& path) const {
    return std::holds_alternative<std::monostate>(stats_.find(path)->value);
  }
  [[nodiscard]] double real(const std::string& path) const {
    return std::get<double>(stats_.find(path)->value);
  }
  [[nodiscard]] std::string text(const std::string& path) const {
    return std::get<std::string>(stats_.find(path)->value);
  }
  [[nodiscard]] const StatsTree& stats() const { return stats_; }

 private:
  Config config_;
  BuildPlan plan_;
  StatsTree stats_;
};

TEST(EnergyReport, IsCountsTimesCoefficients) {
  Report report;
  report.give("trace.primary.lane_inner_visits", 100);
  report.give("trace.primary.lane_triangle_tests", 7);
  report.give("trace.secondary.lane_inner_visits", 11);
  report.give("system.film.num_contributions", 5);
  report.run();
  EXPECT_DOUBLE_EQ(report.real("energy.traversal_unit.steps"), 111 * kNodeStep.picojoule());
  EXPECT_DOUBLE_EQ(report.real("energy.intersection_unit.tests"), 7 * kTriangleTest.picojoule());
  EXPECT_DOUBLE_EQ(report.real("energy.traversal_unit.set_up"), 10 * kRaySetUp.picojoule());
  EXPECT_DOUBLE_EQ(report.real("energy.shader_unit.arithmetic"), 4 * kSurface.picojoule());
  EXPECT_DOUBLE_EQ(report.real("energy.film.addition"), 5 * 3 * 0.9);
}

// 16 KiB of data and 256 tags of 15 bits (28 + 1 bits of address), 8 bytes a look-up, lines of 64.
TEST(EnergyReport, CachesPayForLookUpsFillsAndWriteBacks) {
  Report report;
  const std::string cache = "system.traversal_unit0.node_cache.";
  report.give(cache + "num_accesses", 50);
  report.give(cache + "bytes_read", 3 * 64);
  report.give(cache + "bytes_written", 0);
  report.run();
  const double bytes = 16384 + 256 * (29 - 12 + 2) / 8.0;
  EXPECT_NEAR(report.real("energy.traversal_unit.node_cache"),
              (50 + 3 * 8) * 10 * std::sqrt(bytes / 8192), 1e-9);
}

TEST(EnergyReport, UnitsOfAKindAreAddedUp) {
  Report one;
  Report two;
  for (const char* unit : {"system.traversal_unit0.", "system.traversal_unit1."}) {
    for (const char* counter : {"num_accesses", "bytes_read", "bytes_written"}) {
      two.give(std::string(unit) + "node_cache." + counter, 64);
      if (unit == std::string("system.traversal_unit0.")) {
        one.give(std::string(unit) + "node_cache." + counter, 128);
      }
    }
  }
  one.run();
  two.run();
  EXPECT_DOUBLE_EQ(one.real("energy.traversal_unit.node_cache"),
                   two.real("energy.traversal_unit.node_cache"));
}

TEST(EnergyReport, WhatWasNotCountedIsUnknownAndNotZero) {
  Report report;
  report.run();
  for (const char* item : {"traversal_unit.steps", "traversal_unit.node_cache", "film.addition",
                           "l2.array", "dram.fixed", "dram.interface", "traversal_unit.stack",
                           "machine.leakage", "machine.links"}) {
    EXPECT_TRUE(report.is_unknown(std::string("energy.") + item)) << item;
    EXPECT_NE(report.text("energy.unknown").find(item), std::string::npos) << item;
  }
}

TEST(EnergyReport, WhatIsNotBuiltIsNotReported) {
  Report report({"l2.mode=absent", "dram.model=HBM2-2000"});
  report.run();
  for (const char* item : {"l2.array", "dram.fixed", "shader_unit.texture_cache",
                           "shader_cache.cells", "ray_cache.cells", "traversal_unit.clips"}) {
    EXPECT_FALSE(report.has(std::string("energy.") + item)) << item;
  }
  EXPECT_TRUE(report.is_unknown("energy.dram.refresh"));
}

TEST(EnergyReport, PerfectCachesHaveNoSizeAndSoNoEnergy) {
  Report report({"node_cache.mode=perfect"});
  report.give("system.traversal_unit0.node_cache.num_accesses", 50);
  report.run();
  EXPECT_TRUE(report.is_unknown("energy.traversal_unit.node_cache"));
  EXPECT_NE(report.text("area.unknown").find("node_cache"), std::string::npos);
}

// One decision a pass under interval; all lanes under omni, whose masks are not counted.
TEST(EnergyReport, SchemesPayForTheLanesThatWork) {
  for (const auto& [scheme, expected] : {std::pair{"masked", 30 * kNodeStep.picojoule()},
                                         std::pair{"interval", 4 * kIntervalStep.picojoule()},
                                         std::pair{"omni", 4 * 16 * kNodeStep.picojoule()}}) {
    Report report({std::string("traversal.scheme=") + scheme});
    report.give("trace.primary.packet_inner_visits", 4);
    report.give("trace.primary.lane_inner_visits", 30);
    report.run();
    EXPECT_DOUBLE_EQ(report.real("energy.traversal_unit.steps"), expected) << scheme;
  }
}

TEST(EnergyReport, SumsAndQuotientsFollow) {
  Report report;
  report.give("trace.primary.lane_inner_visits", 1000);
  report.give("system.film.num_contributions", 5);
  report.take(1e-6);
  report.run();
  double sum = 0;
  for (const StatsEntry& entry : report.stats().entries()) {
    const bool item =
        entry.path.starts_with("energy.") && entry.path.find('.', 7) != std::string::npos;
    if (!item) continue;
    if (const auto* value = std::get_if<double>(&entry.value)) sum += *value;
  }
  ASSERT_GT(sum, 0);
  EXPECT_DOUBLE_EQ(report.real("energy.known"), sum);
  EXPECT_DOUBLE_EQ(report.real("energy.per_ray"), sum / 10);
  EXPECT_DOUBLE_EQ(report.real("energy.power"), sum * 1e-12 / 1e-6);
}

TEST(EnergyReport, WithoutTimeThereIsNoPower) {
  Report report;
  report.run();
  EXPECT_TRUE(report.is_unknown("energy.power"));
}

}  // namespace
}  // namespace sheaf
