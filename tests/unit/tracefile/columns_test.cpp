// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/columns.h"

#include <gtest/gtest.h>

#include <limits>

namespace sheaf {
namespace {

constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();

NumberColumn column_of(const std::vector<std::uint64_t>& values) {
  NumberColumn column;
  for (const std::uint64_t value : values) column.put(value);
  return column;
}

TEST(Columns, GiveBackWhatWasWritten) {
  const std::vector<std::uint8_t> bytes{0, 255, 7};
  const std::vector<std::uint64_t> numbers{0, 127, 128, 16383, 16384, kMax};
  const std::vector<std::uint32_t> words{0x3F800000, 0x3F800000, 0xBF800001, 0};
  const std::vector<std::uint64_t> longs{kMax, 1};
  ByteVector raw;
  ColumnWriter writer(raw);
  writer.bytes(bytes);
  writer.numbers(column_of(numbers));
  writer.words(words);
  writer.longs(longs);

  ColumnReader reader(raw);
  std::vector<std::uint8_t> bytes_read;
  std::vector<std::uint64_t> numbers_read;
  std::vector<std::uint32_t> words_read;
  std::vector<std::uint64_t> longs_read;
  reader.bytes(bytes.size(), bytes_read);
  reader.varints(numbers.size(), numbers_read);
  reader.words(words.size(), words_read);
  reader.longs(longs.size(), longs_read);
  EXPECT_EQ(bytes_read, bytes);
  EXPECT_EQ(numbers_read, numbers);
  EXPECT_EQ(words_read, words);
  EXPECT_EQ(longs_read, longs);
  EXPECT_NO_THROW(reader.finish());
}

TEST(Columns, StandLowestByteFirstAndInPlanes) {
  ByteVector raw;
  ColumnWriter writer(raw);
  writer.numbers(column_of({300}));
  writer.words(std::vector<std::uint32_t>{0x04030201, 0x04030201});
  EXPECT_EQ(raw, (ByteVector{2, 0, 0, 0, 0xAC, 0x02, 8, 0, 0, 0, 1, 0, 2, 0, 3, 0, 4, 0}));
}

// Each length, and both sides of each border between two.
TEST(Columns, NumbersHaveSevenBitsAByte) {
  for (int bits = 0; bits < 64; ++bits) {
    for (const std::uint64_t value : {std::uint64_t{1} << bits, (std::uint64_t{1} << bits) - 1}) {
      ByteVector expected;
      std::uint64_t rest = value;
      for (; rest >= 0x80; rest >>= 7) {
        expected.push_back(static_cast<std::uint8_t>(rest % 0x80 + 0x80));
      }
      expected.push_back(static_cast<std::uint8_t>(rest));
      const NumberColumn column = column_of({value});
      const ByteSpan found = column.bytes();
      EXPECT_EQ(ByteVector(found.begin(), found.end()), expected) << value;
    }
  }
}

TEST(Columns, ZigzagIsItsOwnInverseAtTheEnds) {
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1},
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(unzigzag(zigzag(value)), value);
  }
  EXPECT_EQ(zigzag(-1), 1U);
  EXPECT_EQ(zigzag(1), 2U);
}

void read_varints(const ByteVector& content, std::size_t count) {
  ByteVector raw;
  ColumnWriter(raw).bytes(content);
  std::vector<std::uint64_t> values;
  ColumnReader(raw).varints(count, values);
}

TEST(Columns, RefuseNumbersThatAreNone) {
  EXPECT_NO_THROW(read_varints({0x80, 0x01}, 1));
  EXPECT_THROW(read_varints({0x80}, 1), BadColumn);      // cut off
  EXPECT_THROW(read_varints({1, 2}, 1), BadColumn);      // one too many
  EXPECT_THROW(read_varints({1}, 1U << 31), BadColumn);  // no memory is taken for them
  ByteVector long_number(9, 0xFF);
  long_number.push_back(0x02);
  EXPECT_THROW(read_varints(long_number, 1), BadColumn);  // more than 64 bits
  long_number.back() = 0x80;
  long_number.push_back(0);
  EXPECT_THROW(read_varints(long_number, 1), BadColumn);
}

TEST(Columns, RefuseLengthsThatDoNotFit) {
  std::vector<std::uint32_t> words;
  std::vector<std::uint8_t> bytes;
  EXPECT_THROW(ColumnReader(ByteVector{1, 0, 0}).bytes(1, bytes), BadColumn);
  EXPECT_THROW(ColumnReader(ByteVector{9, 0, 0, 0, 1}).bytes(9, bytes), BadColumn);
  EXPECT_THROW(ColumnReader(ByteVector{3, 0, 0, 0, 1, 2, 3}).words(1, words), BadColumn);
  ColumnReader left_over(ByteVector{0, 0, 0, 0, 0});
  EXPECT_THROW(left_over.finish(), BadColumn);
}

}  // namespace
}  // namespace sheaf
