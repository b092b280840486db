// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Ray traces. Checksums keep a fuzzer from the inside of frames, so that the first byte chooses
// between a whole file (0 or 2 modulo 4), the unpacked content of a frame (1), and a trace with
// right checksums (3; sealed_trace.h), of which the byte for the key is the block of pixels.
#include <algorithm>

#include "fuzz_input.h"
#include "sealed_trace.h"
#include "tracefile/columns.h"
#include "tracefile/ray_block.h"
#include "tracefile/ray_lookup.h"
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

/// Looks a ray up, and those that it spawned and that may spawn others.
void follow(sheaf::RayLookup& lookup, const sheaf::RayTag& tag) {
  constexpr std::uint8_t kDeepest = 4;
  const sheaf::RayLookup::Found found = lookup.find(tag);
  if (found.ray->tag.id != tag.id) std::abort();
  std::vector<std::uint32_t> slots;  // what is found is valid until the next ray
  for (const sheaf::SpawnedRay& child : found.children) slots.push_back(child.slot);
  for (const std::uint32_t slot : slots) {
    if (slot > 1 || tag.depth == kDeepest) continue;
    follow(lookup,
           {sheaf::child_ray_id(tag.id, slot), tag.pixel, static_cast<std::uint8_t>(tag.depth + 1),
            slot == 0 ? sheaf::RayKind::kReflection : sheaf::RayKind::kRefraction});
  }
}

void look_up(const std::filesystem::path& path) {
  constexpr std::uint64_t kPixels = 64;
  sheaf::TraceReader reader(path);
  reader.verify();
  const sheaf::TraceMetadata metadata = sheaf::read_metadata(reader);
  sheaf::RayLookup lookup(reader, metadata.width, metadata.height);
  const std::uint64_t pixels = std::uint64_t{metadata.width} * metadata.height;
  for (std::uint32_t pixel = 0; pixel < std::min(pixels, kPixels); ++pixel) {
    follow(lookup, {sheaf::primary_ray_id(pixel), pixel, 0, sheaf::RayKind::kPrimary});
  }
}

void read_sealed(sheaf::ByteSpan input) {
  sheaf::test::read_file("sealed.trace", [&](const std::filesystem::path& path) {
    sheaf::test::seal_trace(path, sheaf::TraceKind::kRays, input,
                            [](std::uint8_t block, std::uint64_t) { return block; });
    look_up(path);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  switch (data[0] % 4) {
    case 1:
      read_block({data + 3, size - 3}, static_cast<std::uint32_t>(data[1] + 256 * data[2]));
      break;
    case 3:
      read_sealed({data + 1, size - 1});
      break;
    default:
      sheaf::test::read_as_file(data + 1, size - 1, "rays.trace", read_file);
  }
  return 0;
}
