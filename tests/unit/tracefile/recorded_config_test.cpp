// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/recorded_config.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "config/config_text.h"
#include "support/scratch_folder.h"
#include "tracefile/trace_writer.h"

namespace sheaf {
namespace {

/// What refuses the configuration `text` of a trace of so many records; empty if nothing does.
std::string refusal_of(TraceKind kind, std::uint32_t num_records, const std::string& text) {
  const test::ScratchFolder scratch;
  TraceWriter writer(scratch / "some.trace", {kind, {}, {}});
  writer.add(0, num_records, [] { return ByteVector{1}; });
  writer.finish("{}");
  const TraceReader reader(scratch / "some.trace");
  TraceMetadata metadata;
  metadata.config = text;
  try {
    static_cast<void>(recorded_config(reader, metadata));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kTrace);
    return error.what();
  }
  return {};
}

std::string refusal_of(TraceKind kind, std::uint32_t num_records,
                       const std::vector<std::string>& settings) {
  return refusal_of(kind, num_records, config_toml(resolve_config({}, settings), Comments::kNone));
}

TEST(RecordedConfig, ThatIsNoneIsTheTracesFault) {
  EXPECT_NE(refusal_of(TraceKind::kMemory, 1, "[l2]\ncolour = 3\n")
                .find("some.trace, recorded configuration"),
            std::string::npos);
  EXPECT_NE(refusal_of(TraceKind::kRays, 1, "[l2]\nways = -1\n").find("l2.ways"),
            std::string::npos);
}

TEST(RecordedConfig, MayHaveSoManyLinesOfAllCachesAndNotOneMore) {
  // 2^25 lines in the L2, and as many in 64 times 2^19 nodes' lines but those of the other caches.
  const std::vector<std::string> none = {
      "triangle_cache.mode=absent", "attribute_cache.mode=absent",
      "texture_cache.mode=absent",  "film_cache.mode=absent",
      "l2.capacity=2GiB",           "traversal_unit.count=64",
      "node_cache.capacity=32MiB"};
  EXPECT_EQ(refusal_of(TraceKind::kMemory, 1, none), "");
  std::vector<std::string> one = none;
  one[3] = "film_cache.mode=normal";
  one.insert(one.end(), {"film_cache.capacity=64B", "film_cache.ways=1"});
  EXPECT_NE(refusal_of(TraceKind::kMemory, 1, one).find("have 67108865 lines"), std::string::npos);
}

TEST(RecordedConfig, OfRaysHasNoPictureThatIsFarLargerThanTheirNumber) {
  const std::vector<std::string> picture = {"image.width=2049", "image.height=2048"};
  EXPECT_EQ(refusal_of(TraceKind::kRays, 2048, picture), "");
  EXPECT_NE(refusal_of(TraceKind::kRays, 2047, picture).find("4196352 pixels, and it holds 2047"),
            std::string::npos);
  EXPECT_EQ(refusal_of(TraceKind::kMemory, 1, picture), "");  // which makes none
}

}  // namespace
}  // namespace sheaf
