// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Slower memory never makes a machine faster whose rays cannot meet differently for it; a perfect
// memory does nearly always make any machine faster.

#include <gtest/gtest.h>

#include <iostream>
#include <stdexcept>

#include "base/random.h"
#include "support/scenes.h"
#include "support/simulate.h"

namespace sheaf::test {
namespace {

const Settings kTinyImage{"image.width=32", "image.height=24"};

/// One of each unit, one context, and packets that are never regrouped.
const Settings kPlainMachine{"ray_cache.heuristic=none",  "traversal_unit.count=1",
                             "intersection_unit.count=1", "shader_unit.count=1",
                             "traversal_unit.contexts=1", "intersection_unit.contexts=1",
                             "shader_unit.contexts=1"};

class Latency : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] std::uint64_t cycles(Settings settings, const Settings& more) const {
    settings.insert(settings.end(), more.begin(), more.end());
    const Outcome outcome = scene_.run(settings);
    if (!outcome.error.empty()) throw std::runtime_error(outcome.error);
    return outcome.count("system.cycles");
  }
  const TestScene scene_{committed_scene(GetParam()), kTinyImage};
};

TEST_P(Latency, OfMemoryNeverShortensARunOfThePlainMachine) {
  for (const char* parameter :
       {"dram.latency", "l2.hit_latency", "link.memory_latency", "node_cache.hit_latency"}) {
    std::uint64_t before = 0;
    for (const char* latency : {"1", "2", "10", "100", "1000", "10000"}) {
      const std::string setting = std::string(parameter) + '=' + latency;
      const std::uint64_t now = cycles(kPlainMachine, {setting});
      EXPECT_GE(now, before) << setting;
      before = now;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, Latency, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

class PerfectMemory : public Latency {};

Settings random_machine(Random& random) {
  const auto one_of = [&](const std::string& key, const std::vector<std::string>& values) {
    return key + '=' + values[random.below(values.size())];
  };
  Settings settings{
      one_of("ray_cache.heuristic", {"none", "dir", "mdir(24)", "fastpos", "pos(1.0)", "opos"}),
      one_of("ray_cache.cells", {"0", "2", "16"}),
      one_of("packet.size", {"4", "16", "64"}),
      one_of("flow.control", {"tile", "credits"}),
      one_of("packet_fifo.depth", {"1", "16"}),
      one_of("dram.latency", {"10", "100", "1000"}),
      one_of("dram.bytes_per_cycle", {"4", "16", "64"}),
      one_of("l2.capacity", {"64KiB", "512KiB"})};
  for (const char* unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
    settings.push_back(one_of(std::string(unit) + ".count", {"1", "2", "4"}));
    settings.push_back(one_of(std::string(unit) + ".contexts", {"1", "4", "8"}));
  }
  return settings;
}

TEST_P(PerfectMemory, WinsInNearlyEveryRun) {
  constexpr int kMachines = 12;
  Random random(7);
  double most_lost = 0.0;
  int num_lost = 0;
  for (int i = 0; i < kMachines; ++i) {
    const Settings machine = random_machine(random);
    const auto normal = static_cast<double>(cycles(machine, {}));
    const auto perfect = static_cast<double>(cycles(
        machine,
        {"node_cache.mode=perfect", "triangle_cache.mode=perfect", "attribute_cache.mode=perfect",
         "texture_cache.mode=perfect", "film_cache.mode=perfect"}));
    if (perfect <= normal) continue;
    ++num_lost;
    most_lost = std::max(most_lost, perfect / normal - 1.0);
    std::cout << "slower with a perfect memory, " << perfect << " for " << normal << " cycles:";
    for (const std::string& setting : machine) std::cout << ' ' << setting;
    std::cout << '\n';
  }
  // None of these 60 machines lost when this was written. One that does is printed above; other
  // rays met in its packets or queues. More of them, or a loss of more, would need another reason.
  EXPECT_LE(num_lost, 1);
  EXPECT_LE(most_lost, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Committed, PerfectMemory, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
