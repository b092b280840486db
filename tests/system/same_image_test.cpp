// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// With the exact film the picture is the same bit for bit, and so are the rays, whatever the
// machine; and the work of masked packets is that of their rays, each traced alone.

#include <gtest/gtest.h>

#include <cstring>

#include "base/random.h"
#include "support/scenes.h"
#include "support/simulate.h"
#include "system/coherence.h"

namespace sheaf::test {
namespace {

const Settings kSmallExactImage{"image.width=48", "image.height=40", "render.recursion_level=2",
                                "film.format=exact"};

/// Values of one parameter, or of several that go together.
using Choices = std::vector<Settings>;

Choices each(const std::string& key, const std::vector<std::string>& values) {
  Choices choices;
  for (const std::string& value : values) choices.push_back({key + '=' + value});
  return choices;
}

Choices each_unit(const std::string& parameter, const std::vector<std::string>& values) {
  Choices choices;
  for (const std::string& value : values) {
    choices.emplace_back();
    for (const char* unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
      choices.back().push_back(std::string(unit) + '.' + parameter + '=' + value);
    }
  }
  return choices;
}

Choices each_cache(const std::string& parameter, const std::vector<std::string>& values) {
  Choices choices;
  for (const std::string& value : values) {
    choices.emplace_back();
    for (const char* cache :
         {"node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film_cache"}) {
      choices.back().push_back(std::string(cache) + '.' + parameter + '=' + value);
    }
  }
  return choices;
}

/// What must not matter: of every part of the machine its numbers, sizes, latencies and policies.
std::vector<Choices> choices() {
  return {each("ray_cache.heuristic", {"none", "dir", "mdir(24)", "mdir(96)", "fastpos", "pos(1.0)",
                                       "opos", "ray5d(1)", "grid(4)"}),
          each("ray_cache.order", {"arrival", "breadth_first"}),
          each("ray_cache.group_by_kind", {"false", "true"}),
          each("ray_cache.resident_voxels", {"0", "4"}),
          each("shader_cache.cells", {"0", "1", "8"}),
          each("shader_cache.key", {"material", "texture"}),
          each("packet.size", {"1", "3", "4", "16", "17", "64"}),
          each("ray_cache.cells", {"1", "2", "8", "96"}),
          each("ray_cache.victim", {"fullest", "oldest", "lru"}),
          each("ray_cache.timeout", {"0", "100"}),
          each("packet_fifo.depth", {"1", "16"}),
          each("link.depth", {"1", "8"}),
          each_unit("count", {"1", "4"}),
          each_unit("contexts", {"1", "8"}),
          each("flow.control", {"tile", "credits", "spill"}),
          each("flow.spill_queue", {"1", "40"}),
          each("node_cache.replacement", {"lru", "plru", "fifo", "random"}),
          each("triangle_cache.sectors", {"1", "4"}),
          each("attribute_cache.ports", {"1", "2"}),
          each("triangle_cache.banks", {"1", "4"}),
          each("film_cache.write_policy", {"back", "through"}),
          each("film_cache.write_allocate", {"true", "false"}),
          each("film_cache.write_buffer", {"0", "2"}),
          each("l2.replacement", {"plru", "random"}),
          each("l2.write_allocate", {"false", "true"}),
          each("l2.write_policy", {"back", "through"}),
          each("l2.mshr_targets", {"0", "1"}),
          {{"crossbar.request_width=32"},
           {"crossbar.request_width=8"},
           {"crossbar.request_width=8", "crossbar.depth=1"}},
          each("crossbar.response_width", {"0", "8"}),
          each("flow.tile_size", {"8", "16", "64"}),
          each("packet_arbiter.policy", {"alternate", "primary_first", "secondary_first"}),
          // Intervals are slow on scattered rays: see TraversalSchemes.
          each("traversal.scheme", {"single", "masked", "omni"}),
          each_cache("capacity", {"1KiB", "64KiB"}),
          each_cache("hit_latency", {"1", "20"}),
          each("node_cache.mode", {"normal", "absent", "perfect"}),
          each("triangle_cache.mode", {"normal", "absent", "perfect"}),
          each("l2.mode", {"normal", "absent", "perfect"}),
          each("l2.capacity", {"16KiB", "4MiB"}),
          each_unit("latency", {"1", "200"}),
          each("link.latency", {"1", "40"}),
          each("link.memory_latency", {"1", "100"}),
          each("dram.model", {"fixed", "DDR4-2400", "LPDDR5-6400"}),
          // Mostly levels that simulate all of the frame in time. (`clocked` would take minutes
          // with such latencies; clocked_test.cpp has it equal `timed`.)
          each("run.fidelity", {"timed", "timed", "timed", "decoupled", "decoupled", "decoupled",
                                "sampled", "analytic", "functional"})};
}

void expect_same(const Outcome& outcome, const Outcome& first, const Settings& settings) {
  ASSERT_EQ(outcome.error, "") << testing::PrintToString(settings);
  EXPECT_TRUE(outcome.complete) << testing::PrintToString(settings);
  ASSERT_EQ(outcome.image.size(), first.image.size());
  EXPECT_EQ(
      std::memcmp(outcome.image.data(), first.image.data(), first.image.size() * sizeof(Vec3)), 0)
      << "another picture with " << testing::PrintToString(settings);
  EXPECT_EQ(outcome.entries({"rays."}), first.entries({"rays."}))
      << testing::PrintToString(settings);
}

class SameImage : public testing::TestWithParam<const char*> {
 protected:
  const TestScene scene_{committed_scene(GetParam()), kSmallExactImage};
};

TEST_P(SameImage, WhateverOneParameterIs) {
  const Outcome first = scene_.run();
  ASSERT_EQ(first.error, "");
  ASSERT_GT(first.count("rays.num_hits"), 500U);
  for (const Choices& parameter : choices()) {
    for (const Settings& settings : parameter) expect_same(scene_.run(settings), first, settings);
  }
}

TEST_P(SameImage, WhateverTheParametersAreTogether) {
  constexpr int kMachines = 16;
  const Outcome first = scene_.run();
  Random random(2026);
  for (int i = 0; i < kMachines; ++i) {
    Settings settings;
    for (const Choices& parameter : choices()) {
      const Settings& choice = parameter[random.below(parameter.size())];
      settings.insert(settings.end(), choice.begin(), choice.end());
    }
    expect_same(scene_.run(settings), first, settings);
  }
}

using MaskedTraversal = SameImage;

TEST_P(MaskedTraversal, HasAsManyActiveLanesAsItsRaysHaveVisitsAlone) {
  CoherencePass alone(scene_.base(), scene_.prepared());
  ASSERT_TRUE(alone.run([] { return false; }));
  for (const char* heuristic : {"none", "dir", "mdir(24)", "fastpos", "pos(1.0)", "opos"}) {
    const std::string sorted = std::string("ray_cache.heuristic=") + heuristic;
    const Outcome masked = scene_.run({sorted, "traversal.scheme=masked"});
    const Outcome single = scene_.run({sorted, "traversal.scheme=single"});
    ASSERT_EQ(masked.error + single.error, "");
    for (const char* counter : {"lane_inner_visits", "lane_leaf_visits", "lane_triangle_tests"}) {
      for (const char* rays : {"trace.primary.", "trace.secondary."}) {
        const std::string path = std::string(rays) + counter;
        EXPECT_EQ(masked.count(path), single.count(path)) << heuristic << ' ' << path;
      }
    }
    EXPECT_EQ(masked.count("trace.primary.lane_inner_visits"), alone.primary().s_t);
    EXPECT_EQ(masked.count("trace.primary.lane_triangle_tests"), alone.primary().i_t);
    EXPECT_EQ(masked.count("trace.secondary.lane_inner_visits"), alone.secondary().s_t);
    EXPECT_EQ(masked.count("trace.secondary.lane_triangle_tests"), alone.secondary().i_t);
    // Else the comparison would be of a packet of one with itself.
    EXPECT_LT(masked.count("trace.primary.packet_inner_visits"), alone.primary().s_t);
  }
}

class TraversalSchemes : public testing::TestWithParam<const char*> {
 protected:
  const TestScene scene_{committed_scene(GetParam()),
                         {"image.width=12", "image.height=12", "render.recursion_level=1",
                          "film.format=exact", "ray_cache.heuristic=none"}};
};

// p_t compares with rays traced alone, also where a packet takes rays elsewhere. Untimed, for an
// interval of scattered rays leads through most of a tree.
TEST_P(TraversalSchemes, FindTheSamePictureAndCountTheSameForRaysAlone) {
  const auto run = [&](const std::string& scheme) {
    return scene_.run({"run.fidelity=functional", "traversal.scheme=" + scheme});
  };
  const Outcome masked = run("masked");
  ASSERT_EQ(masked.error, "");
  for (const char* scheme : {"single", "interval", "interval_entry", "omni"}) {
    const Outcome other = run(scheme);
    ASSERT_NO_FATAL_FAILURE(expect_same(other, masked, {scheme}));
    for (const char* counter : {"lane_inner_visits", "lane_leaf_visits", "lane_triangle_tests"}) {
      const std::string path = std::string("trace.secondary.") + counter;
      EXPECT_EQ(other.count(path), masked.count(path)) << scheme << ' ' << counter;
    }
    const char* const visits = "trace.secondary.packet_inner_visits";
    if (scheme == std::string("omni")) {
      EXPECT_LT(other.count(visits), masked.count(visits));
    } else {
      EXPECT_GT(other.count(visits), masked.count(visits)) << scheme;
    }
  }
}

TEST_P(TraversalSchemes, DoTheSameWorkTimedAsUntimed) {
  for (const char* scheme : {"single", "masked", "interval", "interval_entry", "omni"}) {
    const std::string setting = std::string("traversal.scheme=") + scheme;
    const Outcome timed = scene_.run({setting});
    const Outcome functional = scene_.run({setting, "run.fidelity=functional"});
    ASSERT_NO_FATAL_FAILURE(expect_same(functional, timed, {scheme}));
    EXPECT_EQ(functional.entries({"trace."}), timed.entries({"trace."})) << scheme;
  }
}

INSTANTIATE_TEST_SUITE_P(Committed, SameImage, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });
INSTANTIATE_TEST_SUITE_P(Committed, TraversalSchemes, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });
INSTANTIATE_TEST_SUITE_P(Committed, MaskedTraversal, testing::ValuesIn(kCommittedScenes),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace sheaf::test
