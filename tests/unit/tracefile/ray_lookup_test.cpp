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

/// What refuses to find a ray.
std::string refusal_of(RayLookup& lookup, const RayTag& tag) {
  try {
    static_cast<void>(lookup.find(tag));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kTrace);
    return error.what();
  }
  return {};
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

/// Rays of one pixel, whose identities are those of consecutive numbers.
template <typename Identity>
RayBlock reflections(std::uint32_t count, const Identity& identity) {
  RayBlock block;
  for (std::uint32_t i = 0; i < count; ++i) {
    block.rays.push_back({{identity(i), 20, 1, RayKind::kReflection}, 0, false, true, 0, 0});
  }
  return block;
}

TEST_F(Lookup, FindsEveryRayOfALargeBlock) {
  const auto identity = [](std::uint64_t i) { return child_ray_id(i, 0); };
  write({{1, reflections(50'000, identity)}, {1, one_ray(primary_)}});
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    const RayTag tag{identity(i), 20, 1, RayKind::kReflection};
    ASSERT_EQ(lookup.find(tag).ray->tag.id, tag.id);
  }
}

TEST_F(Lookup, RefusesIdentitiesThatAllCollide) {
  write({{1, reflections(5000, [](std::uint64_t i) { return i << 32U; })}});
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  EXPECT_NE(refusal_of(lookup, primary_).find("identities that Sheaf does not give"),
            std::string::npos);
}

TEST_F(Lookup, EndsAtTheFirstFrameThatRepeatsARay) {
  RayBlock twice = one_ray(primary_);
  twice.rays.push_back(twice.rays[0]);
  twice.rays[1].num_children = 0;
  TraceWriter writer(path_, {});
  ByteVector raw;
  encode_ray_block(twice, grid_, raw);
  writer.add(1, 2, [raw] { return raw; });
  writer.add(1, 1, [] { return ByteVector{0}; });  // no frame: refused if it is unpacked
  writer.finish("{}");
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  EXPECT_NE(refusal_of(lookup, primary_).find("it is in the trace twice"), std::string::npos);
}

TEST_F(Lookup, RefusesABlockThatWouldFillMemory) {
  TraceWriter writer(path_, {});
  for (int i = 0; i < 30; ++i) writer.add(1, 1'000'000, [] { return ByteVector{0}; });
  writer.finish("{}");
  TraceReader reader(path_);
  RayLookup lookup(reader, 32, 16);
  EXPECT_NE(refusal_of(lookup, primary_).find("grows beyond what can be held"), std::string::npos);
}

TEST_F(Lookup, RefusesBlocksOutsideThePicture) {
  write({{2, one_ray(primary_)}});
  TraceReader reader(path_);
  EXPECT_THROW(RayLookup(reader, 32, 16), Error);
}

}  // namespace
}  // namespace sheaf
