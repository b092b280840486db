// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stats/report_tree.h"
#include "stats/sample_estimate.h"
#include "system/analytic_model.h"

namespace sheaf {

// What the fidelities report that estimate.

#define SHEAF_SAMPLE_VALUES(X)                                                            \
  X(num_stretches, "stretches", "Stretches of tiles that the frame is divided into")      \
  X(num_drawn, "stretches", "Of these, measured in time: the last, and others at random") \
  X(num_tiles_timed, "tiles", "Tiles simulated in time, those that warm up included")
SHEAF_VALUES(SampleValues, SHEAF_SAMPLE_VALUES);

#define SHEAF_ESTIMATE_VALUES(X)                                              \
  X(value, "as the quantity", "Estimate for the whole frame")                 \
  X(ci95_low, "as the quantity", "Lower end of its 95 % confidence interval") \
  X(ci95_high, "as the quantity", "Upper end")
SHEAF_VALUES(EstimateValues, SHEAF_ESTIMATE_VALUES);

#define SHEAF_FRAME_ESTIMATE_VALUES(X)                                                         \
  X(cycles_ci95_low, "cycles", "sampled: lower end of the 95 % confidence interval of cycles") \
  X(cycles_ci95_high, "cycles", "sampled: upper end")
SHEAF_VALUES(FrameEstimateValues, SHEAF_FRAME_ESTIMATE_VALUES);

/// As estimate.<quantity>: as none if there is no estimate (NaN), as one number if it has no
/// interval (low and high NaN).
void report_estimate(const CounterInfo& quantity, const Estimate& estimate, StatsTree& stats);

/// The estimated length of the frame where a simulated one would stand.
void report_frame_length(const Estimate& cycles, double frequency, StatsTree& stats);

/// The sums of all tiles and each bound, of a run that has ended. With credits, the length of the
/// frame is the largest of the frame's bounds; tile by tile it is the sum of the tiles' largest.
void report_analytic(const AnalyticModel& model, const Config& config, StatsTree& stats);

}  // namespace sheaf
