// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "memory/dram/stream.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

std::vector<TraceAccess> first(const StreamSpec& spec) {
  AccessStream stream(spec, ddr4());
  std::vector<TraceAccess> accesses;
  TraceAccess access;
  while (stream.next(access)) accesses.push_back(access);
  return accesses;
}

TEST(AccessStream, SequentialGoesOnAccessAfterAccess) {
  const auto accesses = first({.kind = StreamKind::kSequential, .count = 3, .gap = 8});
  ASSERT_EQ(accesses.size(), 3U);
  EXPECT_EQ(accesses[2].address, 128U);
  EXPECT_EQ(accesses[2].arrival, 16U);
  EXPECT_FALSE(accesses[2].write);
}

TEST(AccessStream, RandomIsTheSameForTheSameSeedOnly) {
  const auto a = first({.kind = StreamKind::kRandom, .count = 50, .seed = 1});
  const auto b = first({.kind = StreamKind::kRandom, .count = 50, .seed = 1});
  const auto c = first({.kind = StreamKind::kRandom, .count = 50, .seed = 2});
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(),
                         [](const auto& x, const auto& y) { return x.address == y.address; }));
  EXPECT_NE(a[0].address, c[0].address);
  for (const TraceAccess& access : a) EXPECT_EQ(access.address % 64, 0U);
}

TEST(AccessStream, InterleavedChangesTheBankGroupWithEachAccess) {
  const auto accesses = first({.kind = StreamKind::kInterleaved, .count = 513});
  const AddressMap map = ddr4().map;
  for (std::uint32_t i = 0; i < 512; ++i) {
    const DramLocation where = map.locate(accesses[i].address);
    EXPECT_EQ(where.bank_group, i % 4);
    EXPECT_EQ(where.column, i / 4);
    EXPECT_EQ(where.bank, 0U);
  }
  EXPECT_EQ(map.locate(accesses[512].address).bank, 1U);
}

TEST(AccessStream, ShareOfWritesIsKept) {
  int writes = 0;
  for (const auto& access :
       first({.kind = StreamKind::kRandom, .count = 10'000, .write_share = 0.3})) {
    writes += access.write ? 1 : 0;
  }
  EXPECT_NEAR(writes, 3000, 150);
}

}  // namespace
}  // namespace sheaf::test
