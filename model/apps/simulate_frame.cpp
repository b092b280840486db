// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/simulate_frame.h"

#include <fmt/format.h>

#include "report/progress.h"
#include "system/clocked_machine.h"
#include "system/estimate_report.h"
#include "system/functional_pipeline.h"
#include "system/machine.h"
#include "system/sampled_frame.h"

namespace sheaf {
namespace {

class Simulation {
 public:
  Simulation(const FrameSimulation& given, Frame& frame, StatsTree& stats)
      : in_(given), frame_(frame), stats_(stats) {}

  bool functional() {
    FunctionalPipeline pipeline(in_.config, in_.plan, in_.scene, frame_, in_.hooks);
    const bool complete = pipeline.run(untimed());
    pipeline.report(stats_);
    return complete;
  }

  bool analytic() {
    AnalyticModel model(in_.config, in_.scene);
    FunctionalPipeline pipeline(in_.config, in_.plan, in_.scene, frame_, in_.hooks, &model);
    const bool complete = model.run(pipeline, untimed());
    pipeline.report(stats_);
    if (complete) report_analytic(model, in_.config, stats_);
    return complete;
  }

  bool sampled() {
    SampledFrame sampled(in_.config, in_.plan, in_.scene, frame_);
    return run(sampled);
  }

  bool clocked() {
    ClockedMachine machine(in_.config, in_.plan, in_.scene, frame_, in_.hooks);
    return run(machine);
  }

  bool timed() {
    Machine machine(in_.config, in_.plan, in_.scene, frame_, in_.hooks);
    for (MachineObserver* observer : in_.observers) machine.observe(*observer);
    return run(machine);
  }

 private:
  FunctionalPipeline::Monitor untimed() {
    return [this](double share) {
      progress_.update(share, "tracing");
      return in_.stop();
    };
  }
  template <typename Timed>
  bool run(Timed& machine) {
    const bool complete = machine.run([this](double share, Cycles now) {
      progress_.update(share, fmt::format("cycle {}", now));
      return in_.stop();
    });
    machine.report(stats_);
    return complete;
  }

  const FrameSimulation& in_;
  Frame& frame_;
  StatsTree& stats_;
  Progress progress_;
};

}  // namespace

bool simulate_frame(const FrameSimulation& given, Frame& frame, StatsTree& stats) {
  Simulation simulation(given, frame, stats);
  switch (given.config.run.fidelity) {
    case Fidelity::kFunctional:
      return simulation.functional();
    case Fidelity::kAnalytic:
      return simulation.analytic();
    case Fidelity::kSampled:
      return simulation.sampled();
    case Fidelity::kClocked:
      return simulation.clocked();
    case Fidelity::kDecoupled:
    case Fidelity::kTimed:
      break;
  }
  return simulation.timed();
}

}  // namespace sheaf
