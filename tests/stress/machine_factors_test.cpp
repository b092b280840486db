// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/machine_factors.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "config/parameters.h"

namespace sheaf::stability {
namespace {

std::set<std::string> keys_of_factors() {
  std::set<std::string> keys;
  for (const Factor& factor : machine_factors({"10", "4", {"1GHz", "2GHz"}})) {
    for (const auto& level : factor.levels) {
      for (const std::string& setting : level) keys.insert(setting.substr(0, setting.find('=')));
    }
  }
  return keys;
}

// What is asked of a run, or what the header of the factors says is left alone.
const std::regex kNoFactor(
    "(run|image|render|scene|camera|light|pos|film|kdtree|measure)\\..*|.*\\.seed|.*\\.capacity|"
    "(node|triangle|attribute|texture|film)_cache\\.line|dram\\.(t[A-Z].*|mapping)");

TEST(MachineFactors, NameEveryParameterOfTheMachine) {
  const std::set<std::string> named = keys_of_factors();
  Config config;
  const ParameterTable table = declare_parameters(config);
  for (const Parameter& parameter : table.parameters()) {
    if (std::regex_match(parameter.key, kNoFactor)) continue;
    EXPECT_TRUE(named.contains(parameter.key)) << parameter.key;
  }
}

TEST(MachineFactors, HaveTwoLevelsAndMore) {
  for (const Factor& factor : machine_factors({"10", "4", {"1GHz", "2GHz"}})) {
    EXPECT_GE(factor.levels.size(), 2U) << factor.levels.at(0).at(0);
  }
}

}  // namespace
}  // namespace sheaf::stability
