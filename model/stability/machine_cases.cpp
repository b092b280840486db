// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Stiff machines: rates, sizes and clocks that differ by orders of magnitude.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "stability/catalogue.h"
#include "stability/machine_factors.h"
#include "stability/machine_run.h"

namespace sheaf::stability {
namespace {

std::vector<Finding> stiff_machines(const Effort& effort) {
  const MachineScene scene(2);
  const MachineRun untimed = scene.run({"run.fidelity=functional"});
  const std::vector<Factor> all = machine_factors({"1000000", "64", {"1MHz", "1GHz", "1THz"}});
  const std::size_t strength = effort.quick ? 2 : 3;
  Failures broken;
  Failures pictures;
  Failures rays;
  for (const std::vector<std::string>& settings : covering_machines(all, strength)) {
    const MachineRun run = scene.run(settings);
    const auto where = [&] {
      return fmt::format("--set {}: {}", fmt::join(settings, " --set "), run.error);
    };
    broken.check(run.error.empty(), where);
    if (!run.error.empty()) continue;
    pictures.check(run.picture == untimed.picture, where);
    rays.check(run.rays == untimed.rays, where);
  }
  const std::string every =
      fmt::format("{} factors, every combination of any {}", all.size(), strength);
  const char* const same =
      "the set of rays and their hits is independent of the machine; the exact "
      "film's sums are independent of their order";
  return {broken.finding("machines that hang or lose something; " + every,
                         "every machine that the reader accepts finishes, by the laws of "
                         "conservation that each run checks"),
          pictures.finding("pictures unlike the untimed pipeline's, bit by bit", same),
          rays.finding("ray counts unlike the untimed pipeline's", same)};
}

/// The reference ticks every cycle, so that what is slow takes 10 cycles here.
std::vector<Finding> against_clocked() {
  const MachineScene scene(1);
  Failures unlike;
  const std::vector<Factor> all = machine_factors({"10", "4", {"500MHz", "2GHz"}});
  for (std::vector<std::string> settings : covering_machines(all, 2)) {
    const MachineRun timed = scene.run(settings);
    settings.emplace_back("run.fidelity=clocked");
    const MachineRun clocked = scene.run(settings);
    unlike.check(timed.error.empty() && clocked.error.empty() && timed.cycles == clocked.cycles &&
                     timed.picture == clocked.picture && timed.rays == clocked.rays,
                 [&] {
                   return fmt::format("--set {}: {} cycles, {}; clocked {}, {}",
                                      fmt::join(settings, " --set "), timed.cycles, timed.error,
                                      clocked.cycles, clocked.error);
                 });
  }
  return {unlike.finding("machines whose cycles, picture or rays are not those of clocked",
                         "timed is exact about what clocked models (decision 0040)")};
}

/// One of everything, so that nothing overlaps what takes long: the traversal's issue port.
std::vector<std::string> serial_machine(std::uint64_t interval) {
  return {"traversal_unit.count=1",
          "traversal_unit.contexts=1",
          "traversal_unit.lanes=1",
          "intersection_unit.count=1",
          "intersection_unit.contexts=1",
          "shader_unit.contexts=1",
          "traversal.scheme=single",
          "packet.size=64",
          "flow.tile_size=8",
          fmt::format("traversal_unit.initiation_interval={}", interval)};
}

/// What a run takes is linear in an interval that everything else hides behind, so two short runs
/// say what a long one must take, to the cycle.
std::vector<Finding> long_runs() {
  const MachineScene scene(30);
  const MachineRun once = scene.run(serial_machine(10'000));
  const MachineRun twice = scene.run(serial_machine(20'000));
  const auto slope = static_cast<std::int64_t>((twice.cycles - once.cycles) / 10'000);
  Largest off;
  double longest = 0.0;
  for (const std::int64_t interval : {500'000, 999'999, 1'000'000}) {
    const MachineRun run = scene.run(serial_machine(static_cast<std::uint64_t>(interval)));
    const auto expected = static_cast<std::int64_t>(once.cycles) + slope * (interval - 10'000);
    const double error =
        run.error.empty()
            ? std::abs(static_cast<double>(static_cast<std::int64_t>(run.cycles) - expected))
            : std::nan("");
    off.add(error, [&] { return fmt::format("interval {}: {}", interval, run.error); });
    longest = std::max(longest, static_cast<double>(run.cycles));
  }
  Failures brief;
  brief.check(longest >= 1e12, [&] { return fmt::format("{:.3g} cycles", longest); });
  return {off.finding("cycles off what shorter runs say",
                      {0.0, "a serial machine's time is linear in its slowest interval"}),
          brief.finding("catalogues whose longest run is short of 1e12 cycles", "as named")};
}

std::vector<Finding> clocks() {
  const MachineScene scene(1);
  const MachineRun plain = scene.run({});
  Failures unlike;
  for (const char* frequency : {"1kHz", "7MHz", "3.3GHz", "700GHz", "1THz"}) {
    const MachineRun run = scene.run({fmt::format("clock.frequency={}", frequency)});
    unlike.check(run.error.empty() && run.cycles == plain.cycles,
                 [&] { return fmt::format("{}: {} {}", frequency, run.cycles, run.error); });
  }
  Failures broken;
  for (const char* model : {"DDR4-2400", "HBM2-2000"}) {
    for (const char* frequency : {"1kHz", "7MHz", "3.3GHz", "700GHz", "1THz"}) {
      const MachineRun run = scene.run(
          {fmt::format("dram.model={}", model), fmt::format("clock.frequency={}", frequency)});
      broken.check(run.error.empty() && run.picture == plain.picture,
                   [&] { return fmt::format("{} at {}: {}", model, frequency, run.error); });
    }
  }
  return {unlike.finding("clocks at which memory of fixed latency takes other cycles",
                         "its latency is given in core cycles"),
          broken.finding("machines with banked memory that hang, lose something or change the "
                         "picture",
                         "as for all machines")};
}

/// 1e12 cycles of a millisecond are 30 years: more than SystemC's 64 bits of picoseconds.
std::vector<Finding> slow_clock() {
  const MachineScene scene(30);
  const MachineRun fast = scene.run(serial_machine(1'000'000));
  std::vector<std::string> settings = serial_machine(1'000'000);
  settings.emplace_back("clock.frequency=1kHz");
  const MachineRun slow = scene.run(settings);
  Failures wrong;
  const bool refused = slow.code == ExitCode::kUsage && slow.error.starts_with("clock.frequency");
  wrong.check(refused || (slow.error.empty() && slow.cycles == fast.cycles),
              [&] { return fmt::format("{} cycles, {}", slow.cycles, slow.error); });
  return {wrong.finding("runs neither right nor refused by name",
                        "time is 64 bits of picoseconds (IEEE 1666-2011, section 5.11)")};
}

}  // namespace

std::vector<StabilityCase> machine_cases() {
  return {{"machines", "stiff",
           "latencies and rates of 1 and 1e6, queues from 1, units from 1 to 64, "
           "clocks of 1 MHz and 1 THz",
           stiff_machines},
          {"machines", "against clocked",
           "latencies and rates of 1 and 10, queues of 1 and 1e6, units of 1 and 4, "
           "every policy of the machine",
           [](const Effort&) { return against_clocked(); }},
          {"machines", "long runs", "1e12 cycles", [](const Effort&) { return long_runs(); }},
          {"machines", "clocks", "core clocks from 1 kHz to 1 THz beside memory of 1 to 2 GHz",
           [](const Effort&) { return clocks(); }},
          {"machines", "slow clock", "1e12 cycles at 1 kHz: 30 years",
           [](const Effort&) { return slow_clock(); }}};
}

}  // namespace sheaf::stability
