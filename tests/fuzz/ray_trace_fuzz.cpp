// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Traces. Checksums keep a fuzzer from the inside of frames, so that the first byte chooses between
// a whole file (even) and the unpacked content of a frame (odd).
#include <cstring>

#include "fuzz_input.h"
#include "tracefile/columns.h"
#include "tracefile/ray_block.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_reader.h"

namespace {

void read_file(const std::filesystem::path& path) {
  sheaf::TraceReader reader(path);
  reader.verify();
  static_cast<void>(sheaf::read_metadata(reader));
  sheaf::ByteVector raw;
  for (const sheaf::TraceFrame& frame : reader.frames()) reader.read(frame, raw);
}

void read_block(sheaf::ByteSpan raw, std::uint32_t num_rays) {
  const sheaf::BlockGrid grid(40, 24);
  sheaf::RayBlock block;
  try {
    sheaf::decode_ray_block(raw, num_rays % grid.num_blocks(), num_rays, grid, block);
  } catch (const sheaf::BadColumn&) {
    return;
  }
  for (const sheaf::ShadedRay& ray : block.rays) {
    if (ray.tag.pixel >= 40 * 24) std::abort();
    if (std::uint64_t{ray.first_child} + ray.num_children > block.children.size()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  if (data[0] % 2 == 0) {
    sheaf::test::read_as_file(data + 1, size - 1, "rays.trace", read_file);
  } else {
    read_block({data + 3, size - 3}, static_cast<std::uint32_t>(data[1] + 256 * data[2]));
  }
  return 0;
}
