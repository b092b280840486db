// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The committed traces: what is told of them, what is exported, and that their curves are those of
// caches simulated one by one.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <map>
#include <regex>
#include <sstream>

#include "memory/cache_array.h"
#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "tracefile/miss_curves.h"
#include "tracefile/trace_metadata.h"

namespace sheaf::test {
namespace {

std::filesystem::path committed_trace(const std::string& name) {
  return committed_scene("sponza").parent_path().parent_path() / "traces" / (name + ".trace");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(TraceCommand, TellsWhatATraceHoldsAndThatItIsSound) {
  for (const char* name : {"sponza-rays", "sponza-memory", "dragon-memory"}) {
    const std::string trace = committed_trace(name).string();
    const CommandResult info = run_sheaf({"trace", "info", trace});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("bytes per ray"), std::string::npos) << info.out;
    const CommandResult verify = run_sheaf({"trace", "verify", trace});
    EXPECT_EQ(verify.exit_code, 0) << verify.err;
    EXPECT_NE(verify.out.find("whole and sound"), std::string::npos) << verify.out;
  }
}

TEST(TraceCommand, ExportsInTheFormsOfThreeSimulators) {
  const std::string trace = committed_trace("dragon-memory").string();
  const std::map<std::string, std::regex> forms{
      {"ramulator2", std::regex("LD 0x[0-9a-f]+|ST [0-9]+")},
      {"dramsim3", std::regex("0x[0-9A-F]+ (READ|WRITE) [0-9]+")},
      {"dramsys", std::regex("[0-9]+: (read|write) 0x[0-9a-f]+")}};
  std::size_t num_lines = 0;
  for (const auto& [format, form] : forms) {
    const CommandResult result = run_sheaf({"trace", "export", trace, "--format", format});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::vector<std::string> lines = lines_of(result.out);
    EXPECT_GT(lines.size(), 1000);
    EXPECT_TRUE(num_lines == 0 || num_lines == lines.size());
    num_lines = lines.size();
    for (const std::string& line : lines) ASSERT_TRUE(std::regex_match(line, form)) << line;
  }
}

TEST(TraceCommand, ExportsWhatOurOwnMemoryCanReadAgain) {
  const ScratchFolder scratch;
  const std::string text = (scratch / "dram.txt").string();
  const std::string trace = committed_trace("dragon-memory").string();
  ASSERT_EQ(run_sheaf({"trace", "export", trace, "--out", text}).exit_code, 0);
  EXPECT_EQ(run_sheaf({"memory", text}).exit_code, 0);
  const CommandResult rays =
      run_sheaf({"trace", "export", committed_trace("sponza-rays").string()});
  EXPECT_EQ(rays.exit_code, 6);
  EXPECT_NE(rays.err.find("record it with --record memory"), std::string::npos) << rays.err;
}

TEST(TraceCommand, StreamsWhoseTimesWouldWrapAreRefusedByName) {
  const CommandResult result =
      run_sheaf({"memory", "--generate", "random", "--count", "1099511627776", "--gap", "1000000"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--count 1099511627776 --gap 1000000: "), std::string::npos)
      << result.err;
}

/// What comes out of a pipe until its writer closes it, or it is a pipe no longer.
std::string read_pipe(const std::string& pipe, int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  while (std::filesystem::is_fifo(pipe)) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count == 0 && !text.empty()) break;
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else {
      usleep(1000);
    }
  }
  return text;
}

TEST(TraceCommand, ExportsIntoAPipeAndLeavesItThere) {
  const ScratchFolder scratch;
  const std::string pipe = (scratch / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int file = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(file, 0);
  const std::string trace = committed_trace("dragon-memory").string();
  std::string text;
  const CommandResult result = run_sheaf({"trace", "export", trace, "--out", pipe},
                                         [&](pid_t) { text = read_pipe(pipe, file); });
  close(file);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_TRUE(text == run_sheaf({"trace", "export", trace}).out);
}

/// Puts a trace into a folder of results, and lets a command write there what it makes of it.
void expect_to_be_spared(const std::string& name, const std::string& committed,
                         std::vector<std::string> command) {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch / "result";
  const std::string whole = committed_trace("dragon-memory").string();
  ASSERT_EQ(run_sheaf({"curve", whole, "--out", folder.string()}).exit_code, 0);
  std::filesystem::copy_file(committed_trace(committed), folder / name);
  command.insert(command.end(), {(folder / name).string(), "--out", (folder / ".").string()});
  const CommandResult result = run_sheaf(command);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("holds " + name), std::string::npos) << result.err;
  EXPECT_TRUE(read_bytes(folder / name) == read_bytes(committed_trace(committed)));
}

TEST(TraceCommand, DoesNotReplaceTheTraceThatItReads) {
  expect_to_be_spared("memory.trace", "dragon-memory", {"curve"});
  expect_to_be_spared("memory.trace", "dragon-memory", {"replay"});
  expect_to_be_spared("rays.trace", "sponza-rays",
                      {"replay", "--scene", committed_scene("sponza").string()});
}

TEST(TraceCommand, DoesNotExportOverTheTraceThatItReads) {
  const ScratchFolder scratch;
  const std::string trace = (scratch / "memory.trace").string();
  std::filesystem::copy_file(committed_trace("dragon-memory"), trace);
  EXPECT_EQ(run_sheaf({"trace", "export", trace, "--out", trace}).exit_code, 2);
  EXPECT_TRUE(read_bytes(trace) == read_bytes(committed_trace("dragon-memory")));
}

// Requests are those of untimed caches, so they need not be as many as in time, but nearly.
TEST(TraceCommand, ExportsAboutTheRequestsThatTheRunMade) {
  const ScratchFolder scratch;
  const std::string trace = committed_trace("dragon-memory").string();
  ASSERT_EQ(run_sheaf({"replay", trace, "--quiet", "--out", scratch.path() / "r"}).exit_code, 0);
  const auto live = read_stats(scratch / "r").at("system.dram.num_reads").at("value").get<double>();
  double reads = 0;
  for (const std::string& line : lines_of(run_sheaf({"trace", "export", trace}).out)) {
    reads += line.find("READ") != std::string::npos ? 1 : 0;
  }
  EXPECT_NEAR(reads / live, 1.0, 0.02);
}

class ExportedRequests : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(ExportedRequests, AreAboutThoseOfTheRecordedRunWhateverItsCaches) {
  const ScratchFolder scratch;
  // Small caches, so that it matters what they keep.
  std::vector<std::string> settings{"image.width=48", "image.height=40", "l2.capacity=64KiB",
                                    "l2.ways=4", "node_cache.capacity=2KiB"};
  settings.insert(settings.end(), GetParam().begin(), GetParam().end());
  std::vector<std::string> run =
      run_arguments(committed_scene("dragon"), scratch / "run", settings);
  run.insert(run.end(), {"--record", "memory"});
  ASSERT_EQ(run_sheaf(run).exit_code, 0);
  double reads = 0;
  double writes = 0;
  const std::string trace = (scratch / "run/memory.trace").string();
  for (const std::string& line : lines_of(run_sheaf({"trace", "export", trace}).out)) {
    (line.find("READ") != std::string::npos ? reads : writes) += 1;
  }
  const nlohmann::json live = read_stats(scratch / "run");
  EXPECT_NEAR(reads / live.at("system.dram.num_reads").at("value").get<double>(), 1.0, 0.01);
  EXPECT_NEAR(writes / live.at("system.dram.num_writes").at("value").get<double>(), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Caches, ExportedRequests,
    testing::Values(std::vector<std::string>{"l2.replacement=lru"},
                    std::vector<std::string>{"l2.replacement=plru"},
                    std::vector<std::string>{"l2.replacement=fifo"},
                    std::vector<std::string>{"l2.replacement=random"},
                    std::vector<std::string>{"l2.sectors=2", "node_cache.sectors=2",
                                             "triangle_cache.sectors=2",
                                             "attribute_cache.sectors=2", "texture_cache.sectors=2",
                                             "film_cache.sectors=2"},
                    std::vector<std::string>{"node_cache.replacement=random"},
                    std::vector<std::string>{"l2.write_policy=through"},
                    std::vector<std::string>{"l2.write_allocate=true"},
                    std::vector<std::string>{"film_cache.write_policy=through"},
                    std::vector<std::string>{"film_cache.write_allocate=false"}));

/// Misses of one cache with LRU, simulated by itself on all accesses of a trace.
std::uint64_t simulate(const std::string& trace, const CurveShape& shape, std::uint32_t ways) {
  TraceReader reader(committed_trace(trace));
  const TraceMetadata metadata = read_metadata(reader);
  MemoryAccesses accesses(reader, metadata.memory);
  CacheArray cache(shape.sets, ways);
  std::uint64_t misses = 0;
  std::vector<std::uint64_t> step;
  const auto end_step = [&] {
    std::ranges::sort(step);
    step.erase(std::unique(step.begin(), step.end()), step.end());
    for (const std::uint64_t line : step) {
      if (cache.touch(line)) continue;
      ++misses;
      cache.fill(line, false);
    }
    step.clear();
  };
  for (auto access = accesses.next(); access.record != nullptr; access = accesses.next()) {
    if (!access.record->continues) end_step();
    const Address last = access.record->address + access.operation->bytes - 1;
    for (Address line = access.record->address / shape.line; line <= last / shape.line; ++line) {
      step.push_back(line);
    }
  }
  end_step();
  return misses;
}

TEST(MissCurves, AreThoseOfCachesSimulatedOneByOne) {
  const std::vector<CurveShape> shapes{{64, 1}, {32, 64}, {128, 16}};
  TraceReader reader(committed_trace("dragon-memory"));
  const TraceMetadata metadata = read_metadata(reader);
  MemoryAccesses accesses(reader, metadata.memory);
  const auto curves = measure_miss_curves(accesses, metadata.memory, shapes);
  std::size_t next_shape = 0;
  for (const MissCurveOfStream& curve : curves) {
    if (curve.stream != "all") continue;
    const CurveShape& shape = shapes[next_shape++];
    for (const std::uint32_t ways : {1U, 2U, 4U, 8U, 16U, 64U}) {
      EXPECT_EQ(misses_at(curve.points, ways), simulate("dragon-memory", shape, ways))
          << shape.line << " bytes, " << shape.sets << " sets, " << ways << " ways";
    }
  }
  EXPECT_EQ(next_shape, shapes.size());
}

TEST(MissCurves, OfKindsAndOfCachesAddUpToAllAccesses) {
  TraceReader reader(committed_trace("sponza-memory"));
  const TraceMetadata metadata = read_metadata(reader);
  MemoryAccesses accesses(reader, metadata.memory);
  std::uint64_t all = 0;
  std::uint64_t by_kind = 0;
  std::uint64_t by_cache = 0;
  for (const auto& curve : measure_miss_curves(accesses, metadata.memory, {{64, 1}})) {
    const bool cache = curve.stream.find('.') != std::string::npos;
    (curve.stream == "all" ? all : cache ? by_cache : by_kind) += curve.num_accesses;
  }
  EXPECT_GT(all, 0);
  EXPECT_EQ(by_kind, all);
  EXPECT_EQ(by_cache, all);
}

// A line on its way counts as a merge in time and as a hit without.
TEST(MissCurves, AreNearTheHitsAndMergesOfTheTimedCaches) {
  const ScratchFolder scratch;
  const std::string trace = committed_trace("sponza-memory").string();
  ASSERT_EQ(
      run_sheaf({"replay", trace, "--mode", "fixed", "--quiet", "--out", (scratch / "r").string()})
          .exit_code,
      0);
  const nlohmann::json stats = read_stats(scratch / "r");
  TraceReader reader(trace);
  const TraceMetadata metadata = read_metadata(reader);
  MemoryAccesses accesses(reader, metadata.memory);
  // 16 KiB of 4 ways, as the private caches are by default.
  for (const auto& curve : measure_miss_curves(accesses, metadata.memory, {{64, 64}})) {
    if (!curve.stream.ends_with("node_cache")) continue;
    const auto count = [&](const char* counter) {
      return stats.at("system." + curve.stream + "." + counter).at("value").get<double>();
    };
    EXPECT_EQ(static_cast<double>(curve.num_accesses), count("num_accesses"));
    const double found = (count("num_hits") + count("num_merges")) / count("num_accesses");
    EXPECT_NEAR(1 - curve.miss_ratio(4), found, 0.005) << curve.stream;
  }
}

TEST(MissCurves, NameTheCapacityWhereMissesFall) {
  // A loop over 8 lines: everything misses below 8 ways, nothing but first uses from there.
  StackDistances distances;
  MissCurve curve;
  for (int i = 0; i < 800; ++i) curve.add(distances.access(static_cast<std::uint64_t>(i % 8)));
  const auto knees = find_knees({"all", 64, 1, curve.num_accesses(), curve.points()});
  ASSERT_EQ(knees.size(), 1);
  EXPECT_EQ(knees[0].capacity, 8 * 64);
  EXPECT_DOUBLE_EQ(knees[0].miss_ratio, 0.01);
}

TEST(CurveCommand, WritesTableAndPlot) {
  const ScratchFolder scratch;
  const CommandResult result =
      run_sheaf({"curve", committed_trace("dragon-memory").string(), "--line", "64", "--line", "32",
                 "--sets", "1", "--sets", "64", "--out", (scratch / "curve").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("KiB"), std::string::npos) << result.out;
  const std::vector<std::string> rows = lines_of(read_bytes(scratch / "curve/curve.csv"));
  EXPECT_EQ(rows[0], "stream,line,sets,ways,capacity,accesses,misses,miss_ratio");
  EXPECT_TRUE(rows[1].starts_with("all,64,1,0,0,")) << rows[1];
  EXPECT_TRUE(std::filesystem::exists(scratch / "curve/curve.svg"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "curve/curve.png"));
  for (const char* bad : {"--line=48", "--sets=3", "--line=0"}) {
    EXPECT_EQ(run_sheaf({"curve", committed_trace("dragon-memory").string(), bad}).exit_code, 2);
  }
}

}  // namespace
}  // namespace sheaf::test
