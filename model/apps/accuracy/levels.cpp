// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/accuracy/levels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "apps/own_process.h"
#include "apps/simulate_frame.h"
#include "base/errors.h"
#include "system/build_plan.h"
#include "system/observation.h"
#include "system/observed_stats.h"

namespace sheaf {
namespace {

// Levels that take less are run several times.
constexpr double kCheapSeconds = 2.0;
constexpr std::size_t kRepeats = 3;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

/// What comes back from the process of a run: two times and three numbers a quantity; nothing if
/// it was stopped.
std::vector<double> simulate(const Config& config, const PreparedScene& scene,
                             const std::function<bool()>& stop) {
  const BuildPlan plan = plan_machine(config, scene.scene.needs);
  Frame frame(config);
  StatsTree stats;
  FrameSimulation simulation{config, plan, scene};
  simulation.stop = stop;
  const double processor = processor_seconds();
  const double wall = wall_seconds();
  const bool complete = simulate_frame(simulation, frame, stats);
  std::vector<double> numbers{processor_seconds() - processor, wall_seconds() - wall};
  if (!complete && stop()) return {};
  if (!complete) {
    throw Error(ExitCode::kUsage,
                "run.max_cycles ends a frame that is to be compared; leave it at 0");
  }
  for (const Quantity& quantity : observed_quantities()) {
    const Estimate value = observed(stats, quantity);
    numbers.insert(numbers.end(), {value.value, value.low, value.high});
  }
  return numbers;
}

LevelRun unpack(const Level& level, const std::vector<double>& numbers) {
  LevelRun run{level, numbers.at(0), numbers.at(1), {}};
  for (std::size_t i = 2; i + 2 < numbers.size(); i += 3) {
    run.quantities.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return run;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

const std::vector<Level>& levels() {
  static const std::vector<Level> kLevels{
      {"analytic", {"run.fidelity=analytic"}},
      {"sampled 10%", {"run.fidelity=sampled", "run.sample_share=0.1"}},
      {"sampled 20%", {"run.fidelity=sampled", "run.sample_share=0.2"}},
      {"sampled 40%", {"run.fidelity=sampled", "run.sample_share=0.4"}},
      {"decoupled 64", {"run.fidelity=decoupled", "run.quantum=64"}},
      {"decoupled 16", {"run.fidelity=decoupled", "run.quantum=16"}},
      {"decoupled 4", {"run.fidelity=decoupled", "run.quantum=4"}},
      {"timed", {"run.fidelity=timed"}},
      {"clocked", {"run.fidelity=clocked"}}};
  return kLevels;
}

bool is_rate(std::size_t quantity) {
  return observed_quantities()[quantity].info.name.ends_with("_rate");
}

double LevelRun::error(std::size_t quantity, const LevelRun& reference) const {
  const double value = quantities[quantity].value;
  const double truth = reference.quantities[quantity].value;
  if (is_rate(quantity)) return value - truth;
  return value == truth ? 0.0 : (value - truth) / truth;
}

double LevelRun::uncertainty(std::size_t quantity, const LevelRun& reference) const {
  const Estimate& value = quantities[quantity];
  if (std::isnan(value.low)) return 0.0;
  const double half = (value.high - value.low) / 2;
  return is_rate(quantity) ? half : half / reference.quantities[quantity].value;
}

double LevelRun::reliable_within(const LevelRun& reference) const {
  double worst = 0;
  for (const std::size_t quantity : {kCyclesQuantity, kDramBytesQuantity}) {
    worst =
        std::max({worst, std::fabs(error(quantity, reference)), uncertainty(quantity, reference)});
  }
  return worst;
}

double LevelRun::worst_hit_rate_error(const LevelRun& reference) const {
  double worst = 0;
  for (std::size_t quantity = 0; quantity < quantities.size(); ++quantity) {
    const double distance = error(quantity, reference);
    if (is_rate(quantity) && std::fabs(distance) > std::fabs(worst)) worst = distance;
  }
  return worst;
}

std::optional<LevelRun> run_level(const Level& level, const Config& config,
                                  const PreparedScene& scene, const std::function<bool()>& stop) {
  std::optional<LevelRun> run;
  std::vector<double> processor;
  std::vector<double> wall;
  do {
    const std::vector<double> numbers =
        in_own_process([&] { return simulate(config, scene, stop); }, stop);
    if (numbers.empty()) return std::nullopt;
    run = unpack(level, numbers);
    processor.push_back(run->processor_seconds);
    wall.push_back(run->wall_seconds);
  } while (processor.size() < kRepeats && processor[0] < kCheapSeconds);
  run->processor_seconds = median(processor);
  run->wall_seconds = median(wall);
  return run;
}

std::vector<bool> pareto_front(const std::vector<LevelRun>& runs, const LevelRun& reference) {
  const auto beats = [&](const LevelRun& a, const LevelRun& b) {
    const double error_a = a.reliable_within(reference);
    const double error_b = b.reliable_within(reference);
    return a.processor_seconds <= b.processor_seconds && error_a <= error_b &&
           (a.processor_seconds < b.processor_seconds || error_a < error_b);
  };
  std::vector<bool> front;
  front.reserve(runs.size());
  for (const LevelRun& run : runs) {
    front.push_back(
        std::ranges::none_of(runs, [&](const LevelRun& other) { return beats(other, run); }));
  }
  return front;
}

const LevelRun* cheapest_within(double limit, const std::vector<LevelRun>& runs,
                                const LevelRun& reference) {
  const LevelRun* cheapest = nullptr;
  for (const LevelRun& run : runs) {
    if (run.reliable_within(reference) > limit) continue;
    if (cheapest == nullptr || run.processor_seconds < cheapest->processor_seconds) cheapest = &run;
  }
  return cheapest;
}

}  // namespace sheaf
