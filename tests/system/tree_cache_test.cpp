// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Trees kept from run to run save time and change nothing.

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;

std::string stats_with(const ScratchFolder& scratch, const std::string& name,
                       const std::string& cache) {
  std::vector<std::string> arguments = run_arguments(committed_scene("sponza"), scratch / name,
                                                     {"image.width=32", "image.height=24"});
  arguments.insert(arguments.end(), {"--cache", cache});
  const CommandResult result = run_sheaf(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read_bytes(scratch / name / "stats.json");
}

TEST(KeptTrees, GiveTheSameResultAsTreesBuiltAnew) {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "trees").string();
  const std::string anew = stats_with(scratch, "anew", "none");
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_EQ(stats_with(scratch, "first", folder), anew);
  ASSERT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  const auto kept = fs::last_write_time(fs::directory_iterator(folder)->path());
  EXPECT_EQ(stats_with(scratch, "second", folder), anew);
  EXPECT_GE(fs::last_write_time(fs::directory_iterator(folder)->path()), kept);
}

}  // namespace
}  // namespace sheaf::test
