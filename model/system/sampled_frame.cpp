// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/sampled_frame.h"

#include <limits>
#include <numeric>

#include "system/estimate_report.h"
#include "system/pipeline_parts.h"

namespace sheaf {
namespace {

// What the film still has to do of the tile before, and with credits the tiles that overlap, belong
// to what a tile takes: as many as can be in flight, and one more.
std::uint32_t warm_up_tiles(const Config& config, const BuildPlan& plan, const Scene& scene) {
  return 1 + tiles_in_flight(config, plan, scene);
}

}  // namespace

SampledFrame::SampledFrame(const Config& config, const BuildPlan& plan, const PreparedScene& scene,
                           Frame& frame)
    : config_(config),
      sample_(num_tiles(config), config.run.sample_share, config.run.sample_seed,
              warm_up_tiles(config, plan, scene.scene)),
      timed_frame_(config),
      model_(config, scene),
      untimed_(config, plan, scene, frame, {}, &model_),
      machine_(config, plan, scene, timed_frame_, {nullptr, nullptr, this, sample_.visits()}) {}

bool SampledFrame::run(const Monitor& monitor) {
  monitor_ = monitor;
  const bool timed = machine_.run([this](double share, Cycles now) {
    stopped_ = stopped_ || (monitor_ && monitor_(share, now));
    return stopped_;
  });
  if (!timed || stopped_) return false;
  end_tile(machine_.observation(machine_.end()));
  return model_.run(untimed_,
                    [this](double /*share*/) { return monitor_ && monitor_(1.0, machine_.end()); });
}

void SampledFrame::tile_begins(std::uint32_t tile, Cycles now) {
  const Observation seen = machine_.observation(now);
  end_tile(seen);
  const bool follows = tile == 0 || (in_tile_ && tile == tile_ + 1);
  if (!follows && trace_up_to(tile)) machine_.load_caches(model_.snapshot());
  in_tile_ = true;
  tile_ = tile;
  tile_start_ = seen;
}

// False if the run is to be stopped.
bool SampledFrame::trace_up_to(std::uint32_t tile) {
  model_.take_snapshot_at(tile);
  model_.run(untimed_, [this](double /*share*/) {
    stopped_ = stopped_ || (monitor_ && monitor_(0.0, machine_.clock_domain().now()));
    return stopped_ || model_.has_snapshot();
  });
  return !stopped_;
}

void SampledFrame::end_tile(const Observation& now) {
  if (in_tile_ && sample_.counts(tile_)) {
    measured_[TileSample::stretch_of(tile_)] += now.since(tile_start_);
  }
}

// What was measured of the stretches that were drawn, and what the untimed run says of them.
SampledTotal SampledFrame::total(Observed what, std::vector<double>& measured,
                                 std::vector<double>& rough) const {
  std::vector<double> roughly(sample_.num_stretches());
  const auto tiles = model_.tiles();
  for (std::uint32_t tile = 0; tile < tiles.size(); ++tile) {
    roughly[TileSample::stretch_of(tile)] += static_cast<double>(tiles[tile].seen[what]);
  }
  const auto& drawn = sample_.drawn();
  for (const std::uint32_t stretch : drawn) {
    measured.push_back(static_cast<double>(measured_.at(stretch)[what]));
    rough.push_back(roughly[stretch]);
  }
  const std::size_t random = drawn.size() - 1;  // the last was not left to chance
  return {std::span(measured).first(random), std::span(rough).first(random),
          std::accumulate(roughly.begin(), roughly.end() - 1, 0.0), measured.back()};
}

// How many stretches there are to draw from. Where tiles overlap, what is measured of a stretch
// depends on which others were drawn: an endless population of possible measurements.
std::size_t SampledFrame::population() const {
  const std::size_t all = sample_.num_stretches();
  const bool repeatable = config_.flow.control == FlowPolicy::kTile;
  return repeatable || sample_.drawn().size() == all ? all - 1
                                                     : std::numeric_limits<std::size_t>::max();
}

Estimate SampledFrame::estimate(const Quantity& quantity) const {
  std::vector<double> measured;
  std::vector<double> rough;
  const SampledTotal numerator = total(quantity.total, measured, rough);
  if (quantity.per == Observed::kNone) return estimate_total(numerator, population());
  std::vector<double> measured_per;
  std::vector<double> rough_per;
  const SampledTotal denominator = total(quantity.per, measured_per, rough_per);
  return estimate_ratio(numerator, denominator, population());
}

void SampledFrame::report(StatsTree& stats) const {
  untimed_.report(stats);
  if (measured_.size() != sample_.drawn().size()) return;  // was stopped
  stats.add("sample", SampleValues::num_stretches, sample_.num_stretches());
  stats.add("sample", SampleValues::num_drawn, sample_.drawn().size());
  stats.add("sample", SampleValues::num_tiles_timed, sample_.visits().size());
  for (const Quantity& quantity : observed_quantities()) {
    report_estimate(quantity.info, estimate(quantity), stats);
  }
  report_frame_length(estimate(observed_quantities()[kCyclesQuantity]), config_.clock.frequency,
                      stats);
}

}  // namespace sheaf
