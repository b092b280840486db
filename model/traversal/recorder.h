// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>

#include "traversal/packed_rays.h"
#include "traversal/trace.h"

namespace sheaf {

/// Where a traversal cursor reports what it touched: counts, and if kRecord the log and the counts
/// by lane as far as they are wanted.
template <bool kRecord>
class Recorder {
 public:
  /// Lane numbers will be those of `rays`. `log` and `lanes` may be null.
  Recorder(TraceLog* log, LaneCounts* lanes, const PackedRays& rays)
      : log_(log), lanes_(lanes), rays_(rays) {}

  void inner(std::uint32_t node, LaneMask lanes) {
    ++counts_.packet_inner_visits;
    counts_.lane_inner_visits += count(lanes);
    log(node, 0);
    add(&LaneCounts::inner_visits, lanes);
  }
  void leaf(LaneMask lanes) {
    ++counts_.packet_leaf_visits;
    counts_.lane_leaf_visits += count(lanes);
  }
  void triangle(LaneMask lanes) {
    counts_.lane_triangle_tests += count(lanes);
    add(&LaneCounts::triangle_tests, lanes);
  }
  void leaf_done(std::uint32_t node, std::uint32_t num_tests) {
    counts_.packet_triangle_tests += num_tests;
    log(node, num_tests);
  }
  /// The same of a leaf to whose box the rays were clipped.
  void leaf_clipped(std::uint32_t node, std::uint32_t num_tests) {
    ++counts_.leaf_clips;
    counts_.packet_triangle_tests += num_tests;
    if constexpr (kRecord) {
      if (log_ != nullptr) log_->push_back({node, num_tests, 1});
    }
  }
  /// A node visited to find an entry point.
  void search_inner(std::uint32_t node, LaneMask lanes) {
    ++counts_.search_visits;
    inner(node, lanes);
  }
  void search_leaf(std::uint32_t node) {
    leaf(0);
    leaf_done(node, 0);
  }
  /// What one lane touched alone, by numbers.
  void lane_walked(std::size_t lane, std::uint32_t inner, std::uint32_t leaves,
                   std::uint32_t triangles) {
    counts_.packet_inner_visits += inner;
    counts_.lane_inner_visits += inner;
    counts_.packet_leaf_visits += leaves;
    counts_.lane_leaf_visits += leaves;
    counts_.packet_triangle_tests += triangles;
    counts_.lane_triangle_tests += triangles;
    if constexpr (kRecord) {
      if (lanes_ == nullptr) return;
      lanes_->inner_visits[rays_.packet_lane[lane]] += inner;
      lanes_->triangle_tests[rays_.packet_lane[lane]] += triangles;
    }
  }
  void log(std::uint32_t node, std::uint32_t num_tests) {
    if constexpr (kRecord) {
      if (log_ != nullptr) log_->push_back({node, num_tests, 0});
    }
  }
  [[nodiscard]] const TraceCounts& counts() const { return counts_; }

 private:
  static std::uint64_t count(LaneMask lanes) {
    return static_cast<std::uint64_t>(std::popcount(lanes));
  }
  void add(Lanes<std::uint32_t> LaneCounts::*counters, LaneMask lanes) {
    if constexpr (kRecord) {
      if (lanes_ == nullptr) return;
      for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        ++(lanes_->*counters)[rays_.packet_lane[lane]];
      }
    }
  }

  TraceLog* log_;
  LaneCounts* lanes_;
  const PackedRays& rays_;
  TraceCounts counts_;
};

/// Reports the walk of one lane: counts in registers, which reach the recorder at the end.
template <class Recorder>
class LaneRecorder {
 public:
  LaneRecorder(Recorder& recorder, std::size_t lane) : recorder_(recorder), lane_(lane) {}
  LaneRecorder(const LaneRecorder&) = delete;
  LaneRecorder& operator=(const LaneRecorder&) = delete;
  ~LaneRecorder() { recorder_.lane_walked(lane_, inner_, leaves_, triangles_); }

  void inner(std::uint32_t node) {
    ++inner_;
    recorder_.log(node, 0);
  }
  void leaf() { ++leaves_; }
  void triangles(std::uint32_t count) { triangles_ += count; }
  void leaf_done(std::uint32_t node, std::uint32_t num_tests) { recorder_.log(node, num_tests); }

 private:
  Recorder& recorder_;
  std::size_t lane_;
  std::uint32_t inner_ = 0;
  std::uint32_t leaves_ = 0;
  std::uint32_t triangles_ = 0;
};

}  // namespace sheaf
