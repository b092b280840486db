// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/miss_curves.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace sheaf {
namespace {

constexpr std::uint64_t kAccessesBetweenStops = std::uint64_t{1} << 14;

/// Takes lines together, so that those to come can be fetched ahead. Its sets are made when they
/// are needed: a trace may name many caches that nothing uses.
class CurveBuilder {
 public:
  CurveBuilder(std::string name, const CurveShape& shape) : name_(std::move(name)), shape_(shape) {}
  void add(std::uint64_t line) {
    pending_.push_back(line);
    if (pending_.size() == kTogether) take();
  }
  [[nodiscard]] MissCurveOfStream finish() {
    if (!pending_.empty()) take();
    return {name_, shape_.line, shape_.sets, curve_.num_accesses(), curve_.points()};
  }

 private:
  static constexpr std::size_t kTogether = 1024;
  void take() {
    if (!distances_) distances_.emplace(shape_.sets);
    distances_->access_all(pending_, [&](std::uint32_t distance) { curve_.add(distance); });
    pending_.clear();
  }
  std::string name_;
  CurveShape shape_;
  std::optional<StackDistances> distances_;
  MissCurve curve_;
  std::vector<std::uint64_t> pending_;
};

/// The curves of one shape.
class ShapeCurves {
 public:
  ShapeCurves(const MemoryLayout& layout, const CurveShape& shape)
      : line_shift_(static_cast<unsigned>(std::countr_zero(shape.line))) {
    builders_.emplace_back("all", shape);
    for (std::size_t kind = 0; kind < kNumDataKinds; ++kind) {
      builders_.emplace_back(std::string(to_string(static_cast<DataKind>(kind))), shape);
    }
    for (const MemoryTraceStream& unit : layout.streams) {
      first_cache_.push_back(builders_.size());
      for (const MemoryTraceCache& cache : unit.caches) {
        builders_.emplace_back(unit.name + "." + cache.name, shape);
      }
    }
  }

  void add(const MemoryAccesses::Access& access) {
    if (!access.record->continues) end_step();
    stream_ = access.stream;
    operation_ = access.operation;
    const Address first = access.record->address >> line_shift_;
    const Address last = (access.record->address + access.operation->bytes - 1) >> line_shift_;
    for (Address line = first; line <= last; ++line) lines_.push_back(line);
  }
  void finish(std::vector<MissCurveOfStream>& curves) {
    end_step();
    for (CurveBuilder& builder : builders_) {
      MissCurveOfStream curve = builder.finish();
      if (curve.num_accesses != 0) curves.push_back(std::move(curve));
    }
  }

 private:
  // As a unit does: each line once, in ascending order.
  void end_step() {
    if (lines_.empty()) return;
    if (lines_.size() > 1) {
      std::ranges::sort(lines_);
      const auto repeated = std::ranges::unique(lines_);
      lines_.erase(repeated.begin(), repeated.end());
    }
    for (const std::uint64_t line : lines_) {
      builders_[0].add(line);
      builders_[1 + static_cast<std::size_t>(operation_->kind)].add(line);
      builders_[first_cache_[stream_] + operation_->cache].add(line);
    }
    lines_.clear();
  }

  const unsigned line_shift_;
  std::vector<CurveBuilder> builders_;
  std::vector<std::size_t> first_cache_;  ///< builder of a stream's first cache
  std::vector<std::uint64_t> lines_;      ///< of the step in hand
  std::size_t stream_ = 0;
  const MemoryOperation* operation_ = nullptr;
};

}  // namespace

double MissCurveOfStream::miss_ratio(std::uint64_t ways) const {
  return static_cast<double>(misses_at(points, ways)) / static_cast<double>(num_accesses);
}

std::vector<MissCurveOfStream> measure_miss_curves(MemoryAccesses& accesses,
                                                   const MemoryLayout& layout,
                                                   const std::vector<CurveShape>& shapes,
                                                   const std::function<bool()>& stop) {
  std::vector<ShapeCurves> all;
  for (const CurveShape& shape : shapes) all.emplace_back(layout, shape);
  std::uint64_t num_accesses = 0;
  for (auto access = accesses.next(); access.record != nullptr; access = accesses.next()) {
    if (num_accesses++ % kAccessesBetweenStops == 0 && stop()) break;
    for (ShapeCurves& curves : all) curves.add(access);
  }
  std::vector<MissCurveOfStream> curves;
  for (ShapeCurves& shape : all) shape.finish(curves);
  return curves;
}

std::vector<Knee> find_knees(const MissCurveOfStream& curve) {
  std::vector<Knee> knees;
  const std::uint64_t most = curve.points.back().ways;
  for (std::uint64_t ways = 2; ways / 2 < most; ways *= 2) {
    const double here = curve.miss_ratio(ways);
    const double saved = curve.miss_ratio(ways / 2) - here;
    const double next = here - curve.miss_ratio(2 * ways);
    if (saved >= kKneeShare && saved >= 2 * next) knees.push_back({curve.capacity(ways), here});
  }
  return knees;
}

}  // namespace sheaf
