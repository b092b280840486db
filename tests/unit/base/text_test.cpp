// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

TEST(Text, PrintableIsOneShortLine) {
  EXPECT_EQ(printable("a\nb\x1b[31m"), "a?b?[31m");
  EXPECT_EQ(printable(std::string(1000, 'x')).size(), 123U);
  EXPECT_EQ(printable("four", 4), "four");
  EXPECT_EQ(printable("fives", 4), "five...");
  EXPECT_EQ(printable("M\xc3\xa5nsson"), "M\xc3\xa5nsson");
}

TEST(Text, WrapsAtSpaces) {
  const std::string words(60, 'a');
  EXPECT_EQ(wrapped("one two", "  "), "  one two\n");
  EXPECT_EQ(wrapped(words + " " + words, "  "), "  " + words + "\n  " + words + "\n");
  EXPECT_EQ(wrapped(words + words + " b", ""), words + words + "\nb\n");
  EXPECT_EQ(wrapped("", "  "), "");
}

TEST(Text, DistanceIsTheNumberOfEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("run", "rnu"), 1U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // no letter is edited twice
  EXPECT_EQ(edit_distance("cells", "cells"), 0U);
}

}  // namespace
}  // namespace sheaf
