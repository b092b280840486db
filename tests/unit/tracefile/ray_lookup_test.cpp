// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/ray_lookup.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/scratch_folder.h"
#include "tracefile/trace_writer.h"

namespace sheaf {
namespace {

RayBlock one_ray(const RayTag& tag) {
  RayBlock block;
  block.rays.push_back({tag, 3, true, true, 0, 1});
  block.children.push_back({2, {1, 2, 3}, 4, {0, 0, 1}, {1, 1, 1}});
  return block;
}

class Lookup : public testing::Test {
 protected:
  void write(const std::vector<std::pair<std::uint64_t, RayBlock>>& blocks) {
    TraceWriter writer(path_, {});
    ByteVector raw;
    for (const auto& [number, block] : blocks) {
      encode_ray_block(block, grid_, raw);
      writer.add(number, static_cast<std::uint32_t>(block.rays.size()), [raw] { return raw; });
    }
    writer.finish("{}");
  }
  const test::ScratchFolder scratch_;
  const std::filesystem::path path_ = scratch_ / "rays.trace";
  const BlockGrid grid_{32, 16};
  const RayTag primary_{primary_ray_id(20), 20, 0, RayKind::kPrimary};
  const RayTag reflected_{child_ray_id(primary_.id, 0), 20, 1, RayKind::kReflection};
};

TEST_F(Lookup, FindsRaysOfABlockThatWasWrittenInParts) {
  write({{1, one_ray(primary_)}, {1, one_ray(reflected_)}});
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  for (const RayTag& tag : {primary_, reflected_}) {
    const RayLookup::Found found = lookup.find(tag);
    EXPECT_EQ(found.ray->tag.id, tag.id);
    ASSERT_EQ(found.children.size(), 1U);
    EXPECT_EQ(found.children[0].t_max, 4.0F);
  }
}

TEST_F(Lookup, RefusesRaysThatAreMissingOrThereTwice) {
  write({{1, one_ray(primary_)}});
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  EXPECT_THROW(static_cast<void>(lookup.find(reflected_)), Error);
  EXPECT_THROW(static_cast<void>(lookup.find({primary_ray_id(0), 0, 0, RayKind::kPrimary})), Error);
  write({{1, one_ray(primary_)}, {1, one_ray(primary_)}});
  TraceReader twice(path_);
  RayLookup lookup_twice(twice, 32, 16);
  EXPECT_THROW(static_cast<void>(lookup_twice.find(primary_)), Error);
}

TEST_F(Lookup, RefusesBlocksOutsideThePicture) {
  write({{2, one_ray(primary_)}});
  TraceReader reader(path_);
  EXPECT_THROW(RayLookup(reader, 32, 16), Error);
}

}  // namespace
}  // namespace sheaf
