// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/dram/address_map.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/random.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

constexpr DramOrganization kSmall{.channels = 2,
                                  .ranks = 1,
                                  .bank_groups = 4,
                                  .banks = 4,
                                  .rows = 65536,
                                  .columns = 128,
                                  .burst_bytes = 64};

std::string refusal(const std::string& text) {
  try {
    const AddressMap map(text, kSmall);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

// Bits 5:0 byte, 12:6 column, 14:13 bank group, 16:15 bank, 32:17 row.
TEST(AddressMap, DefaultOfDdr4HasTheFieldsOfTheCommonSetUp) {
  const AddressMap map = ddr4().map;
  EXPECT_EQ(map.locate(Address{1} << 6).column, 1U);
  EXPECT_EQ(map.locate(Address{1} << 12).column, 64U);
  EXPECT_EQ(map.locate(Address{1} << 13).bank_group, 1U);
  EXPECT_EQ(map.locate(Address{1} << 15).bank, 1U);
  EXPECT_EQ(map.locate(Address{1} << 17).row, 1U);
  EXPECT_EQ(map.locate(Address{1} << 32).row, 32768U);
  EXPECT_EQ(map.locate(63), DramLocation{});
}

TEST(AddressMap, FieldInPiecesIsPutTogetherInOrder) {
  const AddressMap map("row bank bankgroup column:5 channel column:2", kSmall);
  EXPECT_EQ(map.locate(64).column, 1U);
  EXPECT_EQ(map.locate(64 * 4).channel, 1U);
  EXPECT_EQ(map.locate(64 * 8).column, 4U);
  EXPECT_EQ(map.bursts_in_a_run(), 4U);
}

TEST(AddressMap, AddressOfIsTheInverseOfLocate) {
  Random random(3);
  for (const char* text : {"row bank bankgroup column channel",
                           "column:3 row channel bank column:4 "
                           "bankgroup"}) {
    const AddressMap map(text, kSmall);
    for (int i = 0; i < 1000; ++i) {
      const Address address = random.below(kSmall.capacity()) & ~Address{63};
      EXPECT_EQ(map.address_of(map.locate(address)), address);
    }
  }
}

TEST(AddressMap, RefusesTooFewBits) {
  EXPECT_NE(refusal("row:15 bank bankgroup column channel").find("'row' 15 bits"),
            std::string::npos);
}

TEST(AddressMap, RefusesTooManyBits) {
  EXPECT_NE(refusal("row bank:3 bankgroup column channel").find("'bank' 3 bits"),
            std::string::npos);
}

TEST(AddressMap, RefusesAMissingField) {
  EXPECT_NE(refusal("row bankgroup column channel").find("'bank' 0 bits"), std::string::npos);
}

TEST(AddressMap, RefusesAnUnknownField) {
  EXPECT_NE(refusal("row bank bankgroup colum channel").find("unknown field 'colum'"),
            std::string::npos);
}

TEST(AddressMap, RefusesAWidthThatIsNoNumber) {
  for (const char* text :
       {"row:x bank", "row:0 bank", "row: bank", "row:99 bank", "row:1.5 bank"}) {
    EXPECT_NE(refusal(text).find("1 to 32 bits"), std::string::npos) << text;
  }
}

TEST(AddressMap, RefusesAFieldWithoutWidthTwice) {
  EXPECT_NE(refusal("row row bank bankgroup column channel").find("twice"), std::string::npos);
}

TEST(AddressMap, FieldsOfOneElementMayBeLeftOutOrNamed) {
  EXPECT_EQ(refusal("row rank bank bankgroup column channel"), "accepted");
}

}  // namespace
}  // namespace sheaf::test
