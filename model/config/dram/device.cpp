// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/dram/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "base/errors.h"
#include "config/dram/presets.h"

namespace sheaf {
namespace {

// The scheduler keeps a bit a bank in one word.
constexpr std::uint32_t kMostBanks = 64;

const DramPreset& preset_of(DramModel model) {
  const auto presets = dram_presets();
  const auto found = std::ranges::find(presets, model, &DramPreset::model);
  if (found == presets.end()) throw std::logic_error("the fixed memory has no device");
  return *found;
}

// Overridden values replace the preset's. tRC and tRTW follow from others unless they are set
// themselves: they are sums, and a forgotten one would contradict its terms.
DramTiming merge(const DramTiming& preset, const DramTiming& overrides) {
  DramTiming t = preset;
#define SHEAF_DRAM_TIMING_MERGE(name, meaning) \
  if (overrides.name != 0) t.name = overrides.name;
  SHEAF_DRAM_TIMINGS(SHEAF_DRAM_TIMING_MERGE)
#undef SHEAF_DRAM_TIMING_MERGE
  if (overrides.tRCDWR == 0 && overrides.tRCD != 0) t.tRCDWR = overrides.tRCD;
  if (overrides.tRC == 0) t.tRC = t.tRAS + t.tRP;
  if (overrides.tRTW == 0) {
    const std::uint32_t preset_gap = preset.tRTW + preset.tCWL - preset.tCL - preset.tBL;
    const std::uint32_t end_of_read = t.tCL + t.tBL + preset_gap;
    t.tRTW = std::max(end_of_read > t.tCWL ? end_of_read - t.tCWL : 1, t.tBL);
  }
  return t;
}

void require(bool holds, const char* left, std::uint64_t left_value, const char* relation,
             const char* right, std::uint64_t right_value, const char* reason) {
  if (holds) return;
  throw Error(ExitCode::kUsage, fmt::format("dram.{} = {} must be {} dram.{} = {}: {}", left,
                                            left_value, relation, right, right_value, reason));
}

void check_timing(const DramTiming& t) {
  const auto at_least = [](const char* left, std::uint64_t a, const char* right, std::uint64_t b,
                           const char* reason) {
    require(a >= b, left, a, "at least", right, b, reason);
  };
  at_least("tRAS", t.tRAS, "tRCD", t.tRCD, "a row is open long enough to be read");
  at_least("tRC", t.tRC, "tRAS", t.tRAS, "a row is closed before another one opens");
  at_least("tCCD_S", t.tCCD_S, "tBL", t.tBL, "two bursts do not overlap on the data bus");
  at_least("tCCD_L", t.tCCD_L, "tCCD_S", t.tCCD_S, "the same bank group is never faster");
  at_least("tRRD_L", t.tRRD_L, "tRRD_S", t.tRRD_S, "the same bank group is never faster");
  at_least("tWTR_L", t.tWTR_L, "tWTR_S", t.tWTR_S, "the same bank group is never faster");
  at_least("tFAW", t.tFAW, "tRRD_S", t.tRRD_S, "four activations span three intervals and more");
  require(t.tREFI > t.tRFC + t.tRC, "tREFI", t.tREFI, "more than tRC +", "tRFC", t.tRFC,
          "refreshes leave time for accesses");
}

void check_controller(const DramSpec& s) {
  require(s.write_high <= s.write_queue, "write_high", s.write_high, "at most", "write_queue",
          s.write_queue, "a drain begins before the queue overflows");
  require(s.write_low < s.write_high, "write_low", s.write_low, "less than", "write_high",
          s.write_high, "a drain takes out what has gathered");
}

void check_power_of_two(const char* key, std::uint32_t value) {
  if (std::has_single_bit(value)) return;
  throw Error(ExitCode::kUsage, fmt::format("dram.{} = {} must be a power of two", key, value));
}

}  // namespace

std::string_view to_string(DramModel model) {
  return model == DramModel::kFixed ? "fixed" : preset_of(model).name;
}

DramDevice resolve_dram(const DramSpec& spec) {
  const DramPreset& preset = preset_of(spec.model);
  DramDevice device;
  device.name = preset.name;
  device.timing_source = preset.timing_source;
  device.clock_hz = preset.clock_hz;
  device.organization = preset.organization;
  if (spec.channels != 0) device.organization.channels = spec.channels;
  if (spec.ranks != 0) device.organization.ranks = spec.ranks;
  check_power_of_two("channels", device.organization.channels);
  check_power_of_two("ranks", device.organization.ranks);
  if (device.organization.banks_per_channel() > kMostBanks) {
    throw Error(
        ExitCode::kUsage,
        fmt::format("dram.ranks = {} makes {} banks a channel; at most {} banks are possible",
                    device.organization.ranks, device.organization.banks_per_channel(),
                    kMostBanks));
  }
  device.separate_row_bus = preset.separate_row_bus;
  device.timing = merge(preset.timing, spec.timing);
  check_timing(device.timing);
  device.energy = preset.energy;
  device.map = AddressMap(spec.mapping.empty() ? preset.mapping : std::string_view(spec.mapping),
                          device.organization);
  check_controller(spec);
  device.page = spec.page;
  device.read_queue = spec.read_queue;
  device.write_queue = spec.write_queue;
  device.write_high = spec.write_high;
  device.write_low = spec.write_low;
  device.row_hit_cap = spec.row_hit_cap;
  device.controller_latency = spec.controller_latency;
  device.refresh = spec.refresh;
  return device;
}

}  // namespace sheaf
