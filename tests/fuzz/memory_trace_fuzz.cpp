// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Memory traces. Checksums keep a fuzzer from metadata and frames, so that the input is these, and
// a trace with right checksums is made of them: JSON up to the first zero byte, then the number of
// records, the stream, and the content of one frame.
#include <algorithm>

#include "fuzz_input.h"
#include "system/dram_requests.h"
#include "tracefile/memory_stream.h"
#include "tracefile/miss_curves.h"
#include "tracefile/recorded_config.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_reader.h"
#include "tracefile/trace_writer.h"

namespace {

void seal(const std::filesystem::path& path, const std::string& metadata, sheaf::ByteSpan frame) {
  sheaf::TraceWriter writer(path, {sheaf::TraceKind::kMemory, {}, {}});
  if (frame.size() > 3) {
    const std::uint32_t num_records = frame[0] + 256U * frame[1];
    const sheaf::ByteVector content(frame.begin() + 3, frame.end());
    writer.add(sheaf::memory_key(frame[2], 0), num_records, [content] { return content; });
  }
  writer.finish(metadata);
}

void read_accesses(const std::filesystem::path& path) {
  sheaf::TraceReader reader(path);
  reader.verify();
  const sheaf::MemoryLayout layout = sheaf::read_metadata(reader).memory;
  sheaf::MemoryAccesses accesses(reader, layout);
  for (auto access = accesses.next(); access.record != nullptr; access = accesses.next()) {
    const sheaf::MemoryTraceStream& stream = layout.streams.at(access.stream);
    if (access.record->context >= stream.contexts) std::abort();
    static_cast<void>(stream.caches.at(access.operation->cache));
  }
}

void make_curves(const std::filesystem::path& path) {
  sheaf::TraceReader reader(path);
  const sheaf::MemoryLayout layout = sheaf::read_metadata(reader).memory;
  sheaf::MemoryAccesses accesses(reader, layout);
  const auto curves = sheaf::measure_miss_curves(accesses, layout, {{64, 1}, {16, 8}});
  for (const sheaf::MissCurveOfStream& curve : curves) {
    if (curve.points.empty() || curve.points.back().misses > curve.num_accesses) std::abort();
  }
}

/// As `sheaf trace export` asks caches for what is left for DRAM.
void filter_requests(const std::filesystem::path& path) {
  sheaf::TraceReader reader(path);
  const sheaf::TraceMetadata metadata = sheaf::read_metadata(reader);
  const sheaf::Config config =
      sheaf::resolve_config_over(sheaf::recorded_config(reader, metadata), std::nullopt, {});
  sheaf::MemoryAccesses accesses(reader, metadata.memory);
  sheaf::DramRequests requests(config, metadata.memory, [](const sheaf::LineAccess& access) {
    if (access.bytes == 0) std::abort();
  });
  for (auto access = accesses.next(); access.record != nullptr; access = accesses.next()) {
    requests.add(access);
  }
  requests.finish();
}

}  // namespace

/// SystemC's library, which comes with the caches, asks for one; nothing is simulated here.
extern "C" int sc_main(int /*argc*/, char** /*argv*/) {
  return 1;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t* const end = data + size;
  const std::uint8_t* const zero = std::find(data, end, 0);
  const std::string metadata(data, zero);
  const std::uint8_t* const frame = zero == end ? end : zero + 1;
  sheaf::test::read_file("memory.trace", [&](const std::filesystem::path& path) {
    seal(path, metadata, {frame, end});
    read_accesses(path);
    make_curves(path);
    filter_requests(path);
  });
  return 0;
}
