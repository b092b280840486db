// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sheaf {
namespace {

TEST(TextTable, AlignsColumnsAndEndsLinesCleanly) {
  TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
  table.add_row({"unit", "busy", "of"});
  table.add_rule();
  table.add_row({"traversal", "7 %"});
  table.add_row({"l2", "100 %", "time"});
  EXPECT_EQ(table.text(2),
            "  unit        busy  of\n"
            "  ----------------------\n"
            "  traversal    7 %\n"
            "  l2         100 %  time\n");
}

TEST(TextTable, CountsLettersNotBytes) {
  TextTable table({Align::kLeft, Align::kLeft});
  table.add_row({"\xc2\xb5s", "a"});
  table.add_row({"ms", "b"});
  EXPECT_EQ(table.text(), "\xc2\xb5s  a\nms  b\n");
}

TEST(TextTable, MoreCellsThanColumnsAreAMistake) {
  TextTable table({Align::kLeft});
  EXPECT_THROW(table.add_row({"a", "b"}), std::logic_error);
}

TEST(Grouped, SeparatesThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(18446744073709551615U), "18,446,744,073,709,551,615");
}

}  // namespace
}  // namespace sheaf
