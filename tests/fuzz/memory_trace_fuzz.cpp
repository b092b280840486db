// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Memory traces with right checksums (sealed_trace.h); the byte for the key is the stream.
#include "fuzz_input.h"
#include "sealed_trace.h"
#include "system/dram_requests.h"
#include "tracefile/memory_stream.h"
#include "tracefile/miss_curves.h"
#include "tracefile/recorded_config.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_reader.h"

namespace {

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
  const sheaf::Config config = sheaf::recorded_config(reader, metadata).config;
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
  sheaf::test::read_file("memory.trace", [&](const std::filesystem::path& path) {
    sheaf::test::seal_trace(path, sheaf::TraceKind::kMemory, {data, size}, sheaf::memory_key);
    read_accesses(path);
    make_curves(path);
    filter_requests(path);
  });
  return 0;
}
