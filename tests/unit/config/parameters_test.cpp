// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "config/check_config.h"

namespace sheaf {
namespace {

class Parameters : public testing::Test {
 protected:
  const Parameter& get(const std::string& key) {
    const Parameter* parameter = table_.find(key);
    if (parameter == nullptr) throw std::out_of_range(key);
    return *parameter;
  }

  Config config_;
  ParameterTable table_ = declare_parameters(config_);
};

TEST_F(Parameters, DeclarationSetsTheDefault) {
  EXPECT_EQ(config_.image.width, 640U);
  EXPECT_EQ(config_.run.fidelity, Fidelity::kTimed);
  EXPECT_EQ(config_.clock.frequency, 1e9);
  EXPECT_EQ(config_.ray_cache.heuristic, "dir");
  EXPECT_EQ(config_.node_cache.capacity, 16384U);
  EXPECT_EQ(config_.film_cache.capacity, 8192U);
  EXPECT_FALSE(config_.scene.reflectance);
}

TEST_F(Parameters, DefaultsAreAPossibleMachine) {
  EXPECT_NO_THROW(check_config(config_));
}

TEST_F(Parameters, KeysAreUniqueAndHaveATableAndAMeaning) {
  std::set<std::string> keys;
  for (const Parameter& parameter : table_.parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_NE(parameter.key.find('.'), std::string::npos) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
    EXPECT_FALSE(parameter.meaning.ends_with('.')) << parameter.key;
  }
}

// Two parameters bound to one field would show up as one assignment that changes two values.
TEST_F(Parameters, EachParameterHasAFieldOfItsOwn) {
  const Config defaults = config_;
  for (const Parameter& parameter : table_.parameters()) {
    if (parameter.type != ParameterType::kCount && parameter.type != ParameterType::kBytes)
      continue;
    const std::string before = parameter.current();
    ASSERT_EQ(parameter.assign(parameter.lowest), "") << parameter.key;
    if (parameter.current() == before) {
      ASSERT_EQ(parameter.assign(parameter.highest), "");
    }
    int changed = 0;
    for (const Parameter& other : table_.parameters()) {
      changed += other.current() == other.default_text ? 0 : 1;
    }
    EXPECT_EQ(changed, 1) << parameter.key;
    config_ = defaults;
  }
}

TEST_F(Parameters, EachRangeHoldsItsEndsAndNothingBeyond) {
  for (const Parameter& parameter : table_.parameters()) {
    if (parameter.type == ParameterType::kCount) {
      const auto lowest = static_cast<std::int64_t>(parameter.lowest);
      const auto highest = static_cast<std::int64_t>(parameter.highest);
      EXPECT_EQ(parameter.assign(lowest), "") << parameter.key;
      EXPECT_EQ(parameter.assign(highest), "") << parameter.key;
      EXPECT_EQ(parameter.current(), std::to_string(highest)) << parameter.key;
      EXPECT_NE(parameter.assign(lowest - 1), "") << parameter.key;
      EXPECT_NE(parameter.assign(highest + 1), "") << parameter.key;
      EXPECT_EQ(parameter.current(), std::to_string(highest)) << "a refused value was kept";
    } else if (parameter.type == ParameterType::kReal) {
      EXPECT_EQ(parameter.assign(parameter.highest), "") << parameter.key;
      EXPECT_NE(parameter.assign(parameter.lowest - 1), "") << parameter.key;
    }
  }
}

TEST_F(Parameters, NanAndInfinityAreNoNumbers) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Parameter& parameter : table_.parameters()) {
    for (const double bad : {std::nan(""), infinity, -infinity}) {
      EXPECT_NE(parameter.assign(bad), "") << parameter.key;
      EXPECT_NE(parameter.assign(std::vector{bad, 0.0, 0.0}), "") << parameter.key;
    }
  }
}

TEST_F(Parameters, RefusalTellsRangeAndUnit) {
  EXPECT_EQ(get("image.width").assign(std::int64_t{0}),
            "0 is out of range; allowed: 1 to 16384 pixels");
  EXPECT_EQ(get("l2.capacity").assign(std::string("2TiB")),
            "\"2TiB\" is out of range; allowed: 64B to 1TiB");
  EXPECT_EQ(get("camera.yfov").assign(200.0),
            "200 is out of range; allowed: off, or 1 to 170 degrees");
}

TEST_F(Parameters, WrongTypesAreRefused) {
  EXPECT_EQ(get("image.width").assign(std::string("wide")),
            "expected a whole number of 1 to 16384 pixels, got \"wide\"");
  EXPECT_EQ(get("image.width").assign(1.5),
            "expected a whole number of 1 to 16384 pixels, got 1.5");
  EXPECT_EQ(get("run.keep_all").assign(std::int64_t{1}), "expected true or false, got 1");
  EXPECT_EQ(get("ray_cache.heuristic").assign(true), "expected a text, got true");
  EXPECT_EQ(get("flow.control").assign(std::string("tiles")),
            "expected one of tile, credits, spill, got \"tiles\"");
  EXPECT_EQ(get("l2.capacity").assign(std::string("32KB")),
            "expected a size such as \"32KiB\" or a number of bytes, got \"32KB\"");
  EXPECT_EQ(get("clock.frequency").assign(std::string("1.5 Ghz")),
            "expected a frequency such as \"1.5GHz\" or a number of hertz, got \"1.5 Ghz\"");
  EXPECT_EQ(get("camera.position").assign(std::vector{1.0, 2.0}),
            "expected three numbers [x, y, z] or \"off\", got an array of 2");
  EXPECT_EQ(get("image.width").assign(UnsupportedValue{"a table"}),
            "expected a whole number of 1 to 16384 pixels, got a table");
}

TEST_F(Parameters, AWholeRealIsACount) {
  EXPECT_EQ(get("dram.latency").assign(1e6), "");
  EXPECT_EQ(config_.dram.latency, 1'000'000U);
}

TEST_F(Parameters, OffUnsetsAnOptionalValueOnly) {
  EXPECT_EQ(get("scene.reflectance").assign(0.5), "");
  EXPECT_EQ(config_.scene.reflectance, 0.5);
  EXPECT_EQ(get("scene.reflectance").assign(std::string("off")), "");
  EXPECT_FALSE(config_.scene.reflectance);
  EXPECT_NE(get("kdtree.empty_bonus").assign(std::string("off")), "");
}

TEST_F(Parameters, CountsAreCutToWhatTheFieldHolds) {
  EXPECT_EQ(get("flow.credits").highest, 4294967295.0);
  EXPECT_EQ(get("run.max_cycles").highest, 281474976710656.0);
}

}  // namespace
}  // namespace sheaf
