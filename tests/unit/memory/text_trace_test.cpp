// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/text_trace.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "support/scratch_folder.h"

namespace sheaf::test {
namespace {

struct TextTraceTest : testing::Test {
  ScratchFolder folder;
  std::string path = (folder.path() / "trace.txt").string();

  void write(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  std::vector<TraceAccess> read(const std::string& text) {
    write(text);
    TextTrace trace(path);
    std::vector<TraceAccess> accesses;
    TraceAccess access;
    while (trace.next(access)) accesses.push_back(access);
    return accesses;
  }
  std::string refusal(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kTrace);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(TextTraceTest, ReadsDramsim3sLines) {
  const auto accesses = read("0x2000D5C0 READ 30\n2000d600 write 31\n\n# comment\n0X0 P_MEM_RD 31");
  ASSERT_EQ(accesses.size(), 3U);
  EXPECT_EQ(accesses[0].address, 0x2000D5C0U);
  EXPECT_EQ(accesses[0].arrival, 30U);
  EXPECT_FALSE(accesses[0].write);
  EXPECT_EQ(accesses[1].address, 0x2000D600U);
  EXPECT_TRUE(accesses[1].write);
}

TEST_F(TextTraceTest, TakesTabsBlanksAndCarriageReturns) {
  EXPECT_EQ(read("  0x40\tREAD   5  \r\n0x80 READ 6\r\n").size(), 2U);
}

TEST_F(TextTraceTest, EmptyFileIsAnEmptyTrace) {
  EXPECT_TRUE(read("").empty());
}

TEST_F(TextTraceTest, ReadsFilesLargerThanItsBuffer) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "0x12345678 READ " + std::to_string(i) + "\n";
  const auto accesses = read(text);
  ASSERT_EQ(accesses.size(), 20'000U);
  EXPECT_EQ(accesses.back().arrival, 19'999U);
}

TEST_F(TextTraceTest, RefusesMalformedLinesByNumber) {
  const std::string good = "0x40 READ 1\n";
  for (const std::string bad :
       {"0x40 READ", "0x40", "0xZZ READ 2", "0x40 FETCH 2", "0x40 READ x", "0x40 READ -1",
        "0x40 READ 1.5", "0x40 READ 2 3", "0x1ffffffffffffffff READ 2",
        "0x40 READ 99999999999999999999", "READ 0x40 2", "\x01\x02\x03"}) {
    const std::string text = refusal(good + "\n" + bad + "\n" + good);
    EXPECT_NE(text.find("trace.txt:3: "), std::string::npos) << bad << ": " << text;
  }
}

TEST_F(TextTraceTest, RefusesArrivalsThatGoBack) {
  EXPECT_NE(refusal("0x40 READ 30\n0x40 READ 29\n").find(":2: arrival 29 is before the last one"),
            std::string::npos);
}

TEST_F(TextTraceTest, ArrivalsEndWhereSumsOfThemWouldWrap) {
  EXPECT_EQ(read("0x40 READ 4503599627370496\n").back().arrival, kLastArrival);
  EXPECT_NE(refusal("0x40 READ 4503599627370497\n").find(":1: '4503599627370497' is no arrival"),
            std::string::npos);
}

TEST_F(TextTraceTest, RefusesEndlessLines) {
  EXPECT_NE(refusal("0x40 READ 1\n" + std::string(1'000'000, 'a')).find(":2: line too long"),
            std::string::npos);
}

TEST_F(TextTraceTest, RefusesWhatIsNotThereOrAFolder) {
  EXPECT_THROW(TextTrace("/nonexistent/trace"), Error);
  TraceAccess access;
  EXPECT_THROW(
      {
        TextTrace trace(folder.path().string());
        trace.next(access);
      },
      Error);
}

}  // namespace
}  // namespace sheaf::test
