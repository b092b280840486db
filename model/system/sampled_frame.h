// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "stats/sample_estimate.h"
#include "system/analytic_model.h"
#include "system/machine.h"
#include "system/tile_sample.h"

namespace sheaf {

/// A frame of which only a random sample of tiles is simulated in time. The whole frame is traced
/// without time beside it, which gives the picture, the rays, a rough figure for every tile
/// (AnalyticModel) and what stands in the caches where a sampled stretch begins; the sample tells
/// by how much the rough figures are wrong, and how sure that is.
///
/// A tile's time begins when its first packet is admitted and ends when the next tile's is. These
/// times add up to the length of the frame, with tile flow control and with credits.
class SampledFrame final : public TileObserver {
 public:
  /// `frame`: filled by the untimed run, completely.
  SampledFrame(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
               Frame& frame);

  using Monitor = Machine::Monitor;
  /// False if `monitor` stopped it; there is nothing to report then but what the untimed run has.
  bool run(const Monitor& monitor);

  /// Of one of observed_quantities().
  [[nodiscard]] Estimate estimate(const Quantity& quantity) const;
  void report(StatsTree& stats) const;

  void tile_begins(std::uint32_t tile, Cycles now) override;

 private:
  bool trace_up_to(std::uint32_t tile);
  void end_tile(const Observation& now);
  [[nodiscard]] SampledTotal total(Observed what, std::vector<double>& measured,
                                   std::vector<double>& rough) const;
  [[nodiscard]] std::size_t population() const;

  const Config config_;
  const TileSample sample_;
  Frame timed_frame_;  ///< what the machine writes, incomplete
  AnalyticModel model_;
  FunctionalPipeline untimed_;
  Machine machine_;
  Monitor monitor_;
  std::map<std::uint32_t, Observation> measured_;  ///< by stretch
  Observation tile_start_;
  std::uint32_t tile_ = 0;
  bool in_tile_ = false;
  bool stopped_ = false;
};

}  // namespace sheaf
