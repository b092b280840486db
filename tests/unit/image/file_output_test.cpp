// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/file_output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "base/errors.h"

namespace sheaf {
namespace {

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

/// While it lives, no file of this process can grow beyond a size.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  FileOutput output(path);
  output.write(bytes);
  output.close();
}

TEST(FileOutput, ReplacesWhatWasThere) {
  const auto path = temporary("sheaf_write_file");
  write_file(path, std::vector<std::uint8_t>(5000, 'x'));
  write_file(path, std::vector<std::uint8_t>{'a', 0, 'b'});
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(content, std::string("a\0b", 3));
  std::filesystem::remove(path);
}

TEST(FileOutput, RemovesWhatWasNotClosed) {
  const auto path = temporary("sheaf_not_closed");
  {
    FileOutput output(path);
    output.write(std::vector<std::uint8_t>(10));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(FileOutput, WritesWhereItWasToldTo) {
  const auto path = temporary("sheaf_seek");
  FileOutput output(path);
  output.write(std::vector<std::uint8_t>{'a', 'b', 'c'});
  output.seek(1);
  EXPECT_EQ(output.position(), 1U);
  output.write(std::vector<std::uint8_t>{'x'});
  output.close();
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(content, "axc");
  std::filesystem::remove(path);
}

TEST(FileOutput, DoesNotForgetAFailureWhoseExceptionWasLost) {
  const auto path = temporary("sheaf_lost_failure");
  const FileSizeLimit limit(20'000);
  {
    FileOutput output(path);
    EXPECT_THROW(output.write(std::vector<std::uint8_t>(100'000)), Error);
    EXPECT_THROW(output.close(), Error);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(FileOutput, LeavesNoHalfWrittenFile) {
  const auto path = temporary("sheaf_half_written");
  const FileSizeLimit limit(20'000);
  EXPECT_THROW(write_file(path, std::vector<std::uint8_t>(100'000)), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(FileOutput, NoticesAFullDiskHoweverLittleItWrites) {
  const std::filesystem::path full = "/dev/full";
  if (!std::filesystem::exists(full)) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  // Little is written only when the file is closed.
  EXPECT_THROW(write_file(full, std::vector<std::uint8_t>(10)), Error);
  EXPECT_THROW(write_file(full, std::vector<std::uint8_t>(1'000'000)), Error);
  EXPECT_TRUE(std::filesystem::exists(full)) << "a device is not to be removed";
}

TEST(FileOutput, NamesFileAndReason) {
  const auto path = temporary("no_such_folder") / "file";
  try {
    write_file(path, {});
    FAIL() << "written into a folder that does not exist";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_EQ(error.what(), path.string() + ": cannot be written: No such file or directory");
  }
}

}  // namespace
}  // namespace sheaf
