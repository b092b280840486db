// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// How long a frame takes, by each latency of a machine in which nothing is decided by time.
//
// A machine with queues can finish earlier for a longer latency, when that lets others go first who
// matter more. Not where who goes first never depends on time. In an orderly machine (generators.h)
// the same events happen in the same order whatever the latencies, and each happens a fixed time
// after the last of those it waits for: it is an event graph, and time in it is the longest path
// (Baccelli, Cohen, Olsder, Quadrat: Synchronization and Linearity, 1992, chapter 2). A path's
// length is a constant plus a latency times the number of times it is met, so that the end, the
// largest of them, grows with each latency, and convexly.
//
// This asks of memory that only one reads from it at a time, and one line at a time: else another
// order at the L2 or of arrival could leave other lines in the caches. Traversal and intersection
// unit take turns; the shader works beside them, so that its caches and the film's always hit. DRAM
// is the fixed one, which has no clock of its own for refresh.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "generators.h"
#include "support/simulate.h"

namespace sheaf::stability {
namespace {

std::vector<std::string> any_memory_of_one_reader() {
  std::vector<std::string> all = any_shared_memory();
  AnySettings settings;
  for (const std::string cache : {"node_cache", "triangle_cache"}) {
    choose_cache(settings, cache);
    settings.choose(cache + ".line", 16, 32, 64);
    settings.choose(cache + ".mshrs", 1);
  }
  for (const std::string cache : {"attribute_cache", "texture_cache", "film_cache"}) {
    settings.choose(cache + ".mode", "perfect");
  }
  settings.choose("dram.model", "fixed");
  all.insert(all.end(), settings.all.begin(), settings.all.end());
  return all;
}

struct Frame {
  std::uint64_t cycles = 0;
  std::uint64_t dram_reads = 0;
  nlohmann::json cache_counts;  ///< what does not tell of time
};

Frame run(const test::TestScene& scene, std::vector<std::string> machine,
          const std::string& setting) {
  machine.push_back(setting);
  const test::Outcome outcome = scene.run(machine);
  RC_ASSERT(outcome.error == "");
  const nlohmann::json caches =
      outcome.entries({"system.traversal_unit0.node_cache.",
                       "system.intersection_unit0.triangle_cache.", "system.l2."});
  Frame frame{outcome.count("system.cycles"), outcome.count("system.dram.num_reads"), {}};
  for (const auto& [key, entry] : caches.items()) {
    if (entry.at("unit") != "cycles") frame.cache_counts[key] = entry;
  }
  return frame;
}

const std::vector<std::string> kLatencies = {"traversal_unit.latency",
                                             "intersection_unit.latency",
                                             "shader_unit.latency",
                                             "traversal_unit.initiation_interval",
                                             "intersection_unit.initiation_interval",
                                             "shader_unit.initiation_interval",
                                             "ray_cache.latency",
                                             "packet_fifo.latency",
                                             "primary_source.interval",
                                             "link.latency",
                                             "node_cache.hit_latency",
                                             "triangle_cache.hit_latency",
                                             "link.memory_latency",
                                             "l2.hit_latency",
                                             "dram.latency"};

std::vector<std::string> any_orderly_machine_and_memory() {
  std::vector<std::string> all = any_orderly_machine();
  const std::vector<std::string> memory = any_memory_of_one_reader();
  all.insert(all.end(), memory.begin(), memory.end());
  return all;
}

RC_GTEST_PROP(LatencyProperty, OfAnOrderlyMachineLengthensTheFrameConvexly, ()) {
  const int level = *rc::gen::inRange(0, 3);
  const test::TestScene scene(any_scene(), {"image.width=8", "image.height=8",
                                            fmt::format("render.recursion_level={}", level)});
  const std::vector<std::string> machine = any_orderly_machine_and_memory();
  const std::uint64_t latency = *rc::gen::inRange(1, 100);
  const std::uint64_t step = *rc::gen::inRange(1, 1000);
  for (const std::string& key : kLatencies) {
    RC_LOG() << fmt::format("{} {} from {} by {}\n", fmt::join(machine, " "), key, latency, step);
    const auto at = [&](std::uint64_t value) {
      return run(scene, machine, fmt::format("{}={}", key, value));
    };
    const Frame first = at(latency);
    const Frame second = at(latency + step);
    const Frame third = at(latency + 2 * step);
    RC_ASSERT(first.cache_counts == second.cache_counts);
    RC_ASSERT(first.cache_counts == third.cache_counts);
    RC_ASSERT(second.cycles >= first.cycles);
    RC_ASSERT(third.cycles >= second.cycles);
    RC_ASSERT(third.cycles - second.cycles >= second.cycles - first.cycles);
    if (key != "dram.latency") continue;
    // No path meets a latency more often than there are such events.
    RC_ASSERT(third.cycles - first.cycles <= 2 * step * first.dram_reads);
  }
}

}  // namespace
}  // namespace sheaf::stability
