// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A machine that cannot make progress ends with an error that names the units that are stuck. No
// configuration that the reader accepts makes one, so these go around its checks.

#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

struct Fault {
  const char* name;
  std::function<void(Config&)> make;
  std::vector<std::string> named;  ///< what the message must name
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class Stuck : public testing::TestWithParam<std::tuple<Fault, std::string>> {};

TEST_P(Stuck, MachineNamesItsStuckUnits) {
  const TestScene scene(committed_scene("sponza"), {"image.width=16", "image.height=16"});
  Config config = scene.base();
  const auto& [fault, fidelity] = GetParam();
  fault.make(config);
  config.run.fidelity = fidelity == "clocked" ? Fidelity::kClocked : Fidelity::kTimed;
  const Outcome outcome = scene.run(config);
  EXPECT_FALSE(outcome.complete);
  EXPECT_NE(outcome.error.find("no more progress"), std::string::npos) << outcome.error;
  for (const std::string& name : fault.named) {
    EXPECT_NE(outcome.error.find(name), std::string::npos) << name << ": " << outcome.error;
  }
  EXPECT_EQ(outcome.error.find('\n'), std::string::npos) << "more than one line";
}

INSTANTIATE_TEST_SUITE_P(
    Faults, Stuck,
    testing::Combine(
        testing::Values(
            Fault{"link", [](Config& c) { c.link.depth = 0; }, {"primary_source"}},
            Fault{"packet_fifo", [](Config& c) { c.packet_fifo.depth = 0; }, {"ray_cache"}},
            Fault{"node_cache", [](Config& c) { c.node_cache.mshrs = 0; }, {"traversal_unit0"}},
            Fault{"triangle_cache",
                  [](Config& c) { c.triangle_cache.mshrs = 0; },
                  {"traversal_unit0", "intersection_unit0"}},
            Fault{"attribute_cache",
                  [](Config& c) { c.attribute_cache.mshrs = 0; },
                  {"shader_unit0"}},
            Fault{"film_cache", [](Config& c) { c.film_cache.mshrs = 0; }, {"film"}},
            Fault{"l2", [](Config& c) { c.l2.mshrs = 0; }, {"l2", "traversal_unit0"}},
            Fault{"l2_crossbar",
                  [](Config& c) {
                    c.l2.mshrs = 0;
                    c.crossbar = {.request_width = 1, .response_width = 1, .depth = 1};
                  },
                  {"l2", "traversal_unit0"}}),
        testing::Values("timed", "clocked")),
    [](const auto& machine) {
      return std::get<Fault>(machine.param).name + ("_" + std::get<std::string>(machine.param));
    });

}  // namespace
}  // namespace sheaf::test
