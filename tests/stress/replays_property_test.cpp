// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Rays recorded on one random machine, replayed on another: what a live run of that gives, byte for
// byte.
#include <gtest/gtest.h>

#include "generators.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::stability {
namespace {

using Arguments = std::vector<std::string>;

std::string stats_of(Arguments arguments, const Arguments& machine,
                     const std::filesystem::path& out) {
  for (const std::string& setting : machine) arguments.insert(arguments.end(), {"--set", setting});
  arguments.insert(arguments.end(), {"--quiet", "--out", out.string()});
  const test::CommandResult result = test::run_sheaf(arguments);
  RC_ASSERT(result.err == "");
  RC_ASSERT(result.exit_code == 0);
  return test::read_bytes(out / "stats.json");
}

RC_GTEST_PROP(ReplaysProperty, OfAnyMachinesTraceOnAnyOtherAreLiveRuns, ()) {
  const test::ScratchFolder scratch;
  const Arguments live = {"run",   test::committed_scene("sponza").string(),
                          "--set", "image.width=16",
                          "--set", "image.height=12",
                          "--set", "render.recursion_level=1"};
  Arguments recorded = live;
  recorded.insert(recorded.end(), {"--record", "rays"});
  stats_of(recorded, any_machine(), scratch / "recorded");
  const Arguments machine = any_machine();
  RC_ASSERT(stats_of({"replay", (scratch / "recorded/rays.trace").string()}, machine,
                     scratch / "replayed") == stats_of(live, machine, scratch / "live"));
}

}  // namespace
}  // namespace sheaf::stability
