// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A small trace asks for no more memory or text than what it holds can need, whatever it says.

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "config/config_text.h"
#include "config/read_config.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "tracefile/memory_recorder.h"
#include "tracefile/trace_metadata.h"

namespace sheaf::test {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;

class HostileTrace : public testing::Test {
 protected:
  /// Writes a memory trace of so many units, each with a chain of `steps` that read `bytes` each,
  /// far apart; `also` of these accesses belong to the first step. What its metadata say is
  /// changed by `forge`.
  void write(
      std::size_t units, std::uint32_t bytes, std::size_t steps, std::size_t also = 0,
      const std::function<void(json&)>& forge = [](json&) {}) {
    TraceWriter writer(trace_, {TraceKind::kMemory, {}, {}});
    MemoryRecorder recorder(writer);
    for (std::size_t i = 0; i < units; ++i) {
      StreamRecorder& unit = recorder.add_stream({.name = "traversal_unit" + std::to_string(i),
                                                  .group = "traversal_unit",
                                                  .caches = {{"node_cache", "node_cache"}}});
      const auto read = [&] { return MemoryOperation{.kind = DataKind::kNode, .bytes = bytes}; };
      const std::uint32_t operation = unit.operation(0, read);
      unit.begin(0, recorder.begin_epoch(10), 14, 14);
      for (std::size_t step = 0; step < steps; ++step) {
        const Address address = step << 30U;
        if (step != 0 && step <= also) {
          unit.also(0, operation, address, 20);
        } else {
          unit.step(0, operation, address, step + 1 == steps, 20 + step);
        }
      }
      unit.end(0, 20 + steps);
    }
    recorder.flush();
    TraceMetadata metadata;
    metadata.version = "0.0.0";
    metadata.scene_name = "none";
    metadata.config = config_toml(resolve_config({}, {}), Comments::kNone);
    metadata.cycles = 1000;
    metadata.width = metadata.height = 16;
    metadata.memory = recorder.layout();
    json all = json::parse(metadata_json(metadata, TraceKind::kMemory));
    forge(all);
    writer.finish(all.dump());
  }

  [[nodiscard]] CommandResult run(std::vector<std::string> command) const {
    command.insert(command.end(), {"--out", (scratch_ / "out").string()});
    return run_sheaf(command);
  }

  static void expect_refused(const CommandResult& result, const std::string& why) {
    EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::kTrace)) << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }

  const ScratchFolder scratch_;
  const std::string trace_ = (scratch_ / "hostile.trace").string();
};

TEST_F(HostileTrace, OfManyUnitsTakesNoMorePeakMemoryThanItsRecordsNeed) {
  write(32, 8, 4);
  const CommandResult result = run({"replay", trace_});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(result.peak_bytes, 200 * kMiB);
}

TEST_F(HostileTrace, OfMoreUnitsThanAMachineCanHaveIsRefused) {
  write(257, 8, 1);
  expect_refused(run({"replay", trace_}), "257 streams");
}

TEST_F(HostileTrace, WhoseStepTouchesMoreThanThereIsIsRefused) {
  write(1, 1U << 24U, 4000, 3999);
  expect_refused(run({"curve", trace_, "--line", "1"}), "touch more than there can be");
  expect_refused(run({"trace", "export", trace_}), "touch more than there can be");
  expect_refused(run({"replay", trace_}), "touch more than there can be");
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out"));
}

TEST_F(HostileTrace, IsRefusedByTheFirstByteTooMany) {
  // 256 bytes for each record on average, and 64 KiB.
  write(1, 256 + 64 * 1024 / 64, 64);
  EXPECT_EQ(run({"curve", trace_}).exit_code, 0);
  write(1, 256 + 64 * 1024 / 64 + 1, 64);
  expect_refused(run_sheaf({"trace", "verify", trace_}), "touch more than there can be");
}

TEST_F(HostileTrace, OfManyCachesThatNothingUsesTakesLittleMemory) {
  write(1, 8, 4, 0, [](json& all) {
    json& streams = all["memory"]["streams"];
    for (std::size_t i = 1; i < 256; ++i) {
      json unit = streams[0];
      unit["name"] = "unit" + std::to_string(i);
      streams.push_back(unit);
    }
  });
  const CommandResult result = run({"curve", trace_, "--sets", "65536"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(result.peak_bytes, 200 * kMiB);
}

TEST_F(HostileTrace, OfManyEmptyFramesIsReadToItsEnd) {
  write(1, 8, 4);
  TraceReader reader(trace_);
  TraceWriter writer(trace_, reader.identity());
  const ByteVector empty = encode_memory_block({}, {});
  for (int i = 0; i < 100'000; ++i) writer.add(memory_key(0, 0), 0, [empty] { return empty; });
  ByteVector raw;
  reader.read(reader.frames()[0], raw);
  writer.add(memory_key(0, 0), reader.frames()[0].num_records, [raw] { return raw; });
  writer.finish(reader.metadata());
  const CommandResult result = run_sheaf({"trace", "export", trace_, "--level", "units"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 4) << result.out;
}

TEST_F(HostileTrace, WhoseNumbersAreNoneIsRefused) {
  struct Forgery {
    const char* place;
    json value;
    const char* why;
  };
  const Forgery forgeries[] = {
      {"/cycles", -1, "cycles is no whole number"},
      {"/rays", 1.5, "rays is no whole number"},
      {"/rays", 1e300, "rays is no whole number"},
      {"/image/width", std::uint64_t{1} + (std::uint64_t{1} << 32U), "width is 4294967297"},
      {"/image/height", "16", "height is no whole number"},
      {"/memory/answer_latency", 1e300, "answer_latency is no whole number"},
      {"/memory/streams/0/contexts", 2.0, "contexts is no whole number"},
      {"/memory/operations/0/bytes", -8, "bytes is no whole number"}};
  for (const Forgery& forgery : forgeries) {
    write(1, 8, 4, 0, [&](json& all) { all[json::json_pointer(forgery.place)] = forgery.value; });
    expect_refused(run_sheaf({"trace", "info", trace_}), forgery.why);
  }
}

TEST_F(HostileTrace, WhoseCachesWouldTakeTerabytesIsRefused) {
  const std::vector<std::string> forgeries[] = {
      {"l2.capacity=1TiB", "l2.line=64"},
      {"l2.capacity=1TiB", "l2.line=64", "l2.replacement=fifo"},
      {"traversal_unit.count=64", "node_cache.capacity=1GiB", "node_cache.line=16"},
      {"intersection_unit.count=64", "triangle_cache.capacity=128MiB", "triangle_cache.line=16"},
      {"shader_unit.count=64", "attribute_cache.sets=1048576"},
      {"shader_unit.count=64", "texture_cache.sets=1048576"},
      {"film_cache.capacity=16GiB"}};
  for (const std::vector<std::string>& settings : forgeries) {
    write(1, 8, 4, 0, [&](json& all) {
      all["config"] = config_toml(resolve_config({}, settings), Comments::kNone);
    });
    const std::vector<std::string> commands[] = {{"replay", trace_},
                                                 {"trace", "export", trace_, "--level", "dram"}};
    for (const std::vector<std::string>& command : commands) {
      const CommandResult result = run(command);
      expect_refused(result, "more than the 67108864 that a trace may ask for");
      EXPECT_LT(result.peak_bytes, 200 * kMiB);
    }
  }
}

}  // namespace
}  // namespace sheaf::test
