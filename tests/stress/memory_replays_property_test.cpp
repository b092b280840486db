// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Memory traces of random machines, replayed.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>

#include "generators.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::stability {
namespace {

using Arguments = std::vector<std::string>;

Arguments operator+(Arguments left, const Arguments& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

nlohmann::json stats_of(Arguments arguments, const Arguments& settings,
                        const std::filesystem::path& out) {
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  RC_LOG() << fmt::format("{}\n", fmt::join(arguments, " "));
  const test::CommandResult result =
      test::run_sheaf(arguments + Arguments{"--quiet", "--out", out.string()});
  RC_ASSERT(result.err == "");
  RC_ASSERT(result.exit_code == 0);
  return test::read_stats(out);
}

/// A recorded run of some scene and its replays.
class Recording {
 public:
  explicit Recording(const Arguments& machine)
      : live(stats_of(
            {"run",
             test::committed_scene(*rc::gen::element("sponza", "dragon", "newtree")).string(),
             "--record", "memory", "--no-images"},
            Arguments{"image.width=12", "image.height=8"} + machine, scratch_ / "live")) {}
  [[nodiscard]] nlohmann::json replay(const std::string& mode, const Arguments& memory = {}) const {
    return stats_of({"replay", (scratch_ / "live/memory.trace").string(), "--mode", mode}, memory,
                    scratch_ / mode);
  }

 private:
  const test::ScratchFolder scratch_;

 public:
  const nlohmann::json live;
};

Arguments any_lines() {
  AnySettings settings;
  for (const std::string& cache : kPrivateCaches) settings.choose(cache + ".line", 16, 32, 64);
  return settings.all;
}

Arguments any_caches() {
  AnySettings settings;
  for (const std::string& cache : kPrivateCaches) {
    choose_cache(settings, cache);
    settings.add(cache + ".mshrs", 1, 8);
    settings.add(cache + ".mshr_targets", 0, 4);
  }
  settings.choose("film_cache.write_policy", "back", "through");
  settings.choose("film_cache.write_allocate", "false", "true");
  settings.add("film_cache.write_buffer", 0, 4);
  return settings.all;
}

/// Caches in which no access ever waits for room, and which hold no modified line in the end: when
/// a replay writes those back, it does not know how long the last rays took to miss everything.
Arguments any_roomy_caches() {
  AnySettings settings;
  for (const std::string& cache : kPrivateCaches) {
    choose_cache(settings, cache);
    settings.choose(cache + ".mshrs", 4096);
  }
  settings.choose("film_cache.write_policy", "through");
  return settings.all;
}

/// What depends on when the last ray was done, with or without an access.
bool is_of_length(const std::string& key) {
  static const std::vector<std::string> kEnds = {"system.cycles",
                                                 "system.seconds",
                                                 ".num_wakes",
                                                 ".bus_utilization",
                                                 ".memory_cycles",
                                                 ".num_refreshes",
                                                 ".refresh_cycles",
                                                 ".active_cycles",
                                                 ".num_precharges",
                                                 ".mean_queued",
                                                 ".energy.refresh",
                                                 ".energy.active_standby",
                                                 ".energy.known",
                                                 ".energy.activate_precharge",
                                                 ".energy.precharge_standby"};
  return std::ranges::any_of(kEnds, [&](const auto& end) { return key.ends_with(end); });
}

/// What a replay reports of the memory and a live run does, too.
template <typename LeftOut>
void expect_alike(const nlohmann::json& live, const nlohmann::json& replay,
                  const LeftOut& is_left_out) {
  for (const auto& [key, entry] : replay.items()) {
    if (!key.starts_with("system.") || !live.contains(key) || is_left_out(key)) continue;
    RC_ASSERT(std::pair(key, entry.dump()) == std::pair(key, live.at(key).dump()));
  }
}

// A unit asks its cache for all lines of a step at once, in a cycle that is recorded; nothing but a
// lack of room can make it ask later.
RC_GTEST_PROP(MemoryReplaysProperty, OfRecordedCyclesAreTheRecordedRunIfNoAccessHadToWaitForRoom,
              ()) {
  const Recording recording(any_recordable_machine() + any_lines() + any_roomy_caches() +
                            any_shared_memory());
  expect_alike(recording.live, recording.replay("fixed"), is_of_length);
}

// Without sorting, what a chain waited for is the step that sent it, at a fixed distance, or the
// only context, which its queue hands on in order. Nothing else holds a unit up if the link to the
// film is never full: what waits for that is not recorded.
RC_GTEST_PROP(MemoryReplaysProperty, OfAnOrderlyMachineAreTheRecordedRunToTheCycle, ()) {
  const Recording recording(any_orderly_machine() + any_lines() + any_caches() +
                            any_shared_memory() +
                            Arguments{"ray_cache.heuristic=none", "link.depth=1000000"});
  expect_alike(recording.live, recording.replay("elastic"),
               [](const std::string& key) { return key == "system.num_wakes"; });
}

/// Line accesses by cache and kind of data, over all units.
std::map<std::string, std::uint64_t> accesses(const nlohmann::json& stats) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [key, entry] : stats.items()) {
    if (!key.ends_with(".num_accesses")) continue;
    for (const std::string cache :
         {"node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film.cache"}) {
      const std::size_t at = key.find('.' + cache + '.');
      if (at != std::string::npos) counts[key.substr(at)] += entry.at("value").get<std::uint64_t>();
    }
  }
  return counts;
}

// The replay itself checks that each of them is a hit, a miss or a merge, and that what leaves a
// level enters the next.
RC_GTEST_PROP(MemoryReplaysProperty, OnAnyOtherMemoryMakeTheRecordedAccesses, ()) {
  const Arguments lines = any_lines();
  const Recording recording(any_recordable_machine() + lines + any_caches() + any_shared_memory());
  const auto expected = accesses(recording.live);
  RC_ASSERT(expected.size() > 5U);
  const Arguments other = lines + any_caches() + any_shared_memory();
  for (const char* mode : {"fixed", "elastic"}) {
    RC_ASSERT(accesses(recording.replay(mode, other)) == expected);
  }
}

}  // namespace
}  // namespace sheaf::stability
