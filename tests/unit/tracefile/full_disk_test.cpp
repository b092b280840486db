// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A limit on file sizes stands for a full disk: both show as a write that fails.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "base/errors.h"
#include "base/random.h"
#include "support/scratch_folder.h"
#include "tracefile/trace_writer.h"

namespace sheaf {
namespace {

ByteVector noise() {
  Random random(1);
  ByteVector bytes(40000);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
  return bytes;
}

class FullDisk : public testing::TestWithParam<rlim_t> {
 protected:
  void SetUp() override {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{GetParam(), before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  void TearDown() override { setrlimit(RLIMIT_FSIZE, &before_); }
  rlimit before_{};
};

TEST_P(FullDisk, EndsInAnErrorAndLeavesNothing) {
  const test::ScratchFolder scratch;
  {
    TraceWriter writer(scratch / "full.trace", {});
    for (int i = 0; i < 5; ++i) writer.add(0, 1, noise);
    try {
      writer.finish("{}");
      FAIL() << "a trace that did not fit was called whole";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kOutput);
      EXPECT_NE(std::string(error.what()).find("no trace is left"), std::string::npos);
    }
    EXPECT_TRUE(writer.failed());
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

// Far more frames than may wait to be written.
TEST_P(FullDisk, KeepsNobodyWaiting) {
  const test::ScratchFolder scratch;
  {
    TraceWriter writer(scratch / "full.trace", {});
    for (int i = 0; i < 100; ++i) writer.add(0, 1, noise);
    EXPECT_TRUE(writer.failed()) << "the run would have gone on to its end for nothing";
    EXPECT_THROW(writer.finish("{}"), Error);
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

// In the header, in a frame, and in what only the last flush writes.
INSTANTIATE_TEST_SUITE_P(At, FullDisk, testing::Values(0, 100000, 200350));

}  // namespace
}  // namespace sheaf
