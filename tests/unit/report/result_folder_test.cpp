// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/result_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "base/errors.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

class ResultFolderTest : public testing::Test {
 protected:
  ResultFolderTest()
      : root_(fs::temp_directory_path() / ("sheaf_result_folder_" + std::to_string(getpid()))) {
    fs::create_directories(root_);
  }
  ~ResultFolderTest() override { fs::remove_all(root_); }

  static void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

  static std::string get(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  static std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
  }

  static void finish_a_run(const fs::path& folder, const std::string& text) {
    ResultFolder result(folder);
    result.write("config.toml", text);
    result.write("stats.json", text);
    result.commit();
  }

  static std::string refusal(const fs::path& folder) {
    try {
      const ResultFolder result(folder);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kOutput);
      return error.what();
    }
    return "accepted";
  }

  fs::path root_;
};

TEST_F(ResultFolderTest, CommitPutsTheFilesInPlace) {
  const fs::path folder = root_ / "new" / "result";
  {
    ResultFolder result(folder);
    result.write("stats.json", "{}");
    put(result.stage("image.png"), "pixels");
    result.write("config.toml", std::string("a\0b\n", 4));
    EXPECT_EQ(names_in(folder), (std::set<std::string>{".sheaf-partial"}));
    result.commit();
  }
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"stats.json", "image.png", "config.toml"}));
  EXPECT_EQ(get(folder / "config.toml"), std::string("a\0b\n", 4));
  EXPECT_EQ(get(folder / "image.png"), "pixels");
}

TEST_F(ResultFolderTest, AFailedRunLeavesNoTrace) {
  {
    ResultFolder result(root_ / "new" / "deeper" / "result");
    result.write("stats.json", "{}");
  }
  EXPECT_TRUE(names_in(root_).empty());
}

TEST_F(ResultFolderTest, AFailedRunLeavesTheFormerResult) {
  finish_a_run(root_ / "result", "first");
  {
    ResultFolder result(root_ / "result");
    result.write("config.toml", "second");
    result.write("stats.json", "second");
  }
  EXPECT_EQ(get(root_ / "result" / "stats.json"), "first");
  EXPECT_EQ(names_in(root_ / "result"), (std::set<std::string>{"config.toml", "stats.json"}));
}

TEST_F(ResultFolderTest, ANewResultReplacesTheFormerOneWhole) {
  const fs::path folder = root_ / "result";
  finish_a_run(folder, "first");
  put(folder / "image.exr", "of the former run");
  put(folder / "notes.txt", "the user's");
  finish_a_run(folder, "second");
  EXPECT_EQ(get(folder / "stats.json"), "second");
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"config.toml", "stats.json", "notes.txt"}));
}

TEST_F(ResultFolderTest, HasNoNameThatASuccessorWouldNotRemove) {
  ResultFolder result(root_ / "result");
  EXPECT_THROW(static_cast<void>(result.stage("other.csv")), std::logic_error);
}

TEST_F(ResultFolderTest, ASecondRunAtTheSameTimeIsRefusedAndLeavesTheFirstAlone) {
  const fs::path folder = root_ / "result";
  ResultFolder first(folder);
  first.write("config.toml", "first");
  EXPECT_EQ(refusal(folder), folder.string() +
                                 ": another run is writing here; wait for its end, or choose "
                                 "another folder with --out");
  first.write("stats.json", "first");
  first.commit();
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"config.toml", "stats.json"}));
}

TEST_F(ResultFolderTest, IsFreeAgainAfterARunThatWasKilled) {
  const fs::path folder = root_ / "result";
  const pid_t child = fork();
  if (child == 0) {
    const ResultFolder killed(folder);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(fs::exists(folder / ".sheaf-partial"));
  finish_a_run(folder, "second");
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"config.toml", "stats.json"}));
}

TEST_F(ResultFolderTest, AKilledRunCanBeRunAgain) {
  const fs::path folder = root_ / "result";
  fs::create_directories(folder / ".sheaf-partial");
  put(folder / ".sheaf-partial" / "image.exr", "half");
  finish_a_run(folder, "second");
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"config.toml", "stats.json"}));
}

TEST_F(ResultFolderTest, AnEmptyFolderIsTaken) {
  fs::create_directory(root_ / "empty");
  finish_a_run(root_ / "empty", "x");
  EXPECT_TRUE(fs::exists(root_ / "empty" / "stats.json"));
}

TEST_F(ResultFolderTest, AFolderOfOtherThingsIsRefusedAndLeftAlone) {
  put(root_ / "thesis.tex", "precious");
  put(root_ / "config.toml", "a user's own");
  EXPECT_EQ(refusal(root_), root_.string() +
                                ": holds files that are no result of Sheaf; choose a new folder "
                                "with --out, or empty it");
  EXPECT_EQ(names_in(root_), (std::set<std::string>{"thesis.tex", "config.toml"}));
}

TEST_F(ResultFolderTest, WhatCannotBeWrittenIsRefused) {
  put(root_ / "file", "");
  EXPECT_EQ(refusal(root_ / "file"),
            (root_ / "file").string() + ": is no folder; choose another with --out");
  EXPECT_NE(refusal(root_ / "file" / "result"), "accepted");
  EXPECT_NE(refusal("/proc/sheaf_result"), "accepted");
  EXPECT_NE(refusal(""), "accepted");
  EXPECT_EQ(names_in(root_), (std::set<std::string>{"file"}));
}

TEST_F(ResultFolderTest, TheFolderIsExactlyTheOneAskedFor) {
  fs::current_path(root_);
  finish_a_run("relative", "x");
  finish_a_run("slash/", "x");
  finish_a_run("up/../sideways", "x");
  fs::create_directory("inside");
  fs::current_path("inside");
  finish_a_run(".", "x");
  fs::current_path("/");
  for (const char* name : {"relative", "slash", "sideways", "inside"}) {
    EXPECT_TRUE(fs::exists(root_ / name / "stats.json")) << name;
  }
}

TEST_F(ResultFolderTest, ACommitThatFailsLeavesNoMarkOfAWholeResult) {
  finish_a_run(root_ / "result", "first");
  ResultFolder result(root_ / "result");
  static_cast<void>(result.stage("image.exr"));  // and never writes it
  result.write("stats.json", "{}");
  EXPECT_THROW(result.commit(), Error);
  EXPECT_FALSE(fs::exists(root_ / "result" / "stats.json"));
}

TEST_F(ResultFolderTest, AFullDiskIsTold) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  ResultFolder result(root_ / "result");
  fs::create_symlink("/dev/full", result.stage("stats.json"));
  EXPECT_THROW(result.write("stats.json", "{}"), Error);
}

}  // namespace
}  // namespace sheaf
