// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/ray_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/errors.h"
#include "tracefile/columns.h"

namespace sheaf {
namespace {

constexpr std::size_t kMaxHeldBytes = std::size_t{64} << 20;
// Of one block, unpacked: a hundred thousand rays for each of its pixels.
constexpr std::size_t kMaxBlockBytes = std::size_t{1} << 30;
// Slots that are looked at to find free ones. Identities are hashes, of which each needs about one
// and a half in a table that is half full; a few rays may need what they like.
constexpr std::size_t kProbesPerRay = 16;
constexpr std::size_t kProbesPerBlock = 4096;

}  // namespace

RayLookup::RayLookup(TraceReader& reader, std::uint32_t width, std::uint32_t height)
    : reader_(reader), grid_(width, height), width_(width), frames_(reader.frames()) {
  for (const TraceFrame& frame : frames_) {
    if (frame.key >= grid_.num_blocks()) reader.refuse(frame, "the picture has no such block");
  }
  std::ranges::stable_sort(frames_, {}, &TraceFrame::key);
}

void RayLookup::refuse(const RayTag& tag, const std::string& problem) const {
  throw Error(ExitCode::kTrace,
              fmt::format("{}: pixel ({}, {}), ray {:016x} of depth {}: {}; record it again",
                          reader_.path().string(), tag.pixel % width_, tag.pixel / width_, tag.id,
                          tag.depth, problem));
}

RayLookup::Found RayLookup::find(const RayTag& tag) {
  Block& at = block(grid_.block_of(tag.pixel));
  const std::size_t mask = at.slots.size() - 1;
  for (std::size_t slot = tag.id & mask; at.slots[slot] != 0; slot = (slot + 1) & mask) {
    const ShadedRay& ray = at.content.rays[at.slots[slot] - 1];
    if (ray.tag.id != tag.id) continue;
    return {&ray, std::span(at.content.children).subspan(ray.first_child, ray.num_children)};
  }
  refuse(tag, "it is not in the trace");
}

RayLookup::Block& RayLookup::block(std::uint64_t number) {
  if (last_ != nullptr && last_->number == number) return *last_;
  auto& held = blocks_[number];
  if (held == nullptr) {
    held = load(number);
    held_bytes_ += held->num_bytes();
    held->last_use = ++num_uses_;
    make_room();
  }
  held->last_use = ++num_uses_;
  last_ = held.get();
  return *last_;
}

// Lets the blocks that have not been used for longest go, but never the newest.
void RayLookup::make_room() {
  while (held_bytes_ > kMaxHeldBytes && blocks_.size() > 1) {
    const auto oldest = std::ranges::min_element(
        blocks_, {}, [](const auto& entry) { return entry.second->last_use; });
    held_bytes_ -= oldest->second->num_bytes();
    blocks_.erase(oldest);
  }
}

// A frame is looked at before the next one is unpacked, so that it ends with the first one that
// repeats what was there.
std::unique_ptr<RayLookup::Block> RayLookup::load(std::uint64_t number) {
  auto loaded = std::make_unique<Block>();
  loaded->number = number;
  const auto frames = std::ranges::equal_range(frames_, number, {}, &TraceFrame::key);
  std::size_t num_rays = 0;
  for (const TraceFrame& frame : frames) {
    num_rays += frame.num_records;
    if (num_rays > kMaxBlockBytes / sizeof(ShadedRay)) refuse_size(frame);
  }
  loaded->content.rays.reserve(num_rays);
  loaded->slots.assign(std::bit_ceil(2 * num_rays + 2), 0);
  for (const TraceFrame& frame : frames) {
    reader_.read(frame, raw_);
    try {
      decode_ray_block(raw_, number, frame.num_records, grid_, loaded->content);
    } catch (const BadColumn& problem) {
      reader_.refuse(frame, problem.what());
    }
    if (loaded->content.num_bytes() > kMaxBlockBytes) refuse_size(frame);
    index(*loaded, frame);
  }
  return loaded;
}

void RayLookup::refuse_size(const TraceFrame& frame) const {
  reader_.refuse(frame, "its block of the picture grows beyond what can be held");
}

// The rays of a frame that has just been unpacked.
void RayLookup::index(Block& block, const TraceFrame& frame) const {
  const std::vector<ShadedRay>& rays = block.content.rays;
  const std::size_t mask = block.slots.size() - 1;
  for (std::size_t i = rays.size() - frame.num_records; i < rays.size(); ++i) {
    std::size_t slot = rays[i].tag.id & mask;
    for (; block.slots[slot] != 0; slot = (slot + 1) & mask) {
      if (rays[block.slots[slot] - 1].tag.id == rays[i].tag.id) {
        refuse(rays[i].tag, "it is in the trace twice");
      }
      ++block.num_probes;
    }
    block.slots[slot] = static_cast<std::uint32_t>(i + 1);
    if (block.num_probes > kProbesPerRay * (i + 1) + kProbesPerBlock) {
      reader_.refuse(frame, "its rays have identities that Sheaf does not give");
    }
  }
}

}  // namespace sheaf
