// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/check_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "base/errors.h"
#include "base/text.h"
#include "config/config_text.h"
#include "config/dram/device.h"
#include "config/parameters.h"
#include "config/quantities.h"

namespace sheaf {
namespace {

constexpr std::array<std::string_view, 3> kHeatMaps{"rays", "node_visits", "triangle_tests"};

[[noreturn]] void refuse(const std::string& rule) {
  throw Error(ExitCode::kUsage, rule);
}

void check_power_of_two(const std::string& key, std::uint64_t value, const std::string& shown) {
  if (!std::has_single_bit(value)) {
    refuse(fmt::format("{} = {} must be a power of two", key, shown));
  }
}

/// Set-associative geometry: whole sets, and a power of two of them, so that the set is a field of
/// the address.
template <typename Spec>
void check_sets(const std::string& name, const Spec& spec, std::uint64_t banks) {
  if (spec.capacity > kMaxCacheBytes) {
    refuse(fmt::format("{}.sets = {} makes a capacity of {}; at most {} are possible", name,
                       spec.sets, format_bytes(spec.capacity), format_bytes(kMaxCacheBytes)));
  }
  const Bytes row = spec.line * spec.ways * banks;
  const std::string terms = banks > 1 ? "line x ways x banks" : "line x ways";
  if (spec.capacity % row != 0) {
    refuse(fmt::format("{}.capacity = {} must be a multiple of {} = {}", name,
                       format_bytes(spec.capacity), terms, format_bytes(row)));
  }
  if (!std::has_single_bit(spec.capacity / row)) {
    refuse(fmt::format("{}.capacity = {} over {} = {} makes {} sets, which must be a power of two",
                       name, format_bytes(spec.capacity), terms, format_bytes(row),
                       spec.capacity / row));
  }
}

// The tree of bits of a set is kept in one word.
constexpr std::uint32_t kMostPlruWays = 64;
constexpr Bytes kSmallestSector = 16;

template <typename Spec>
void check_cache(const std::string& name, const Spec& spec) {
  check_power_of_two(name + ".line", spec.line, format_bytes(spec.line));
  check_power_of_two(name + ".banks", spec.banks, fmt::format("{}", spec.banks));
  check_power_of_two(name + ".sectors", spec.sectors, fmt::format("{}", spec.sectors));
  if (spec.line / spec.sectors < kSmallestSector) {
    refuse(
        fmt::format("{}.sectors = {} makes sectors of {} of a line of {}; at least {} are needed",
                    name, spec.sectors, format_bytes(spec.line / spec.sectors),
                    format_bytes(spec.line), format_bytes(kSmallestSector)));
  }
  if (spec.sets != 0) check_power_of_two(name + ".sets", spec.sets, fmt::format("{}", spec.sets));
  if (spec.replacement == Replacement::kPlru &&
      (!std::has_single_bit(spec.ways) || spec.ways > kMostPlruWays)) {
    refuse(fmt::format("{}.ways = {} must be a power of two up to {} with replacement = plru", name,
                       spec.ways, kMostPlruWays));
  }
}

void check_private_cache(const std::string& name, const CacheSpec& spec, const L2Spec& l2) {
  if (spec.mode == CacheMode::kPerfect) return;
  check_cache(name, spec);
  if (l2.mode == CacheMode::kNormal && spec.line > l2.line) {
    refuse(fmt::format("{}.line = {} must not be larger than l2.line = {}", name,
                       format_bytes(spec.line), format_bytes(l2.line)));
  }
  if (l2.mode == CacheMode::kNormal && spec.line / spec.sectors > l2.line / l2.sectors) {
    refuse(fmt::format("{}.line / sectors = {} must not be larger than l2.line / sectors = {}",
                       name, format_bytes(spec.line / spec.sectors),
                       format_bytes(l2.line / l2.sectors)));
  }
  if (spec.mode == CacheMode::kNormal) check_sets(name, spec, 1);
}

void check_crossbar(const CrossbarSpec& spec) {
  if (spec.depth != 0 && spec.request_width == 0) {
    refuse(
        fmt::format("crossbar.depth = {} needs a crossbar.request_width; without one nothing "
                    "waits",
                    spec.depth));
  }
}

void check_memory(const Config& c) {
  if (c.l2.mode != CacheMode::kPerfect) check_cache("l2", c.l2);
  if (c.l2.mode == CacheMode::kNormal) check_sets("l2", c.l2, c.l2.banks);
  check_private_cache("node_cache", c.node_cache, c.l2);
  check_private_cache("triangle_cache", c.triangle_cache, c.l2);
  check_private_cache("attribute_cache", c.attribute_cache, c.l2);
  check_private_cache("texture_cache", c.texture_cache, c.l2);
  check_private_cache("film_cache", c.film_cache, c.l2);
  check_crossbar(c.crossbar);
  if (c.dram.model != DramModel::kFixed) static_cast<void>(resolve_dram(c.dram));
}

void check_flow(const Config& c) {
  const std::uint64_t tile = std::uint64_t{c.flow.tile_size} * c.flow.tile_size;
  if (tile < c.packet.size) {
    refuse(fmt::format("flow.tile_size = {} makes tiles of {} pixels, fewer than packet.size = {}",
                       c.flow.tile_size, tile, c.packet.size));
  }
  if (c.flow.control == FlowPolicy::kCredits && c.flow.credits != 0 &&
      c.flow.credits < c.packet.size) {
    refuse(fmt::format("flow.credits = {} admits no packet of packet.size = {} rays",
                       c.flow.credits, c.packet.size));
  }
}

void check_run(const RunSpec& run) {
  const bool timed = run.fidelity != Fidelity::kFunctional && run.fidelity != Fidelity::kAnalytic;
  if (run.max_cycles != 0 && !timed) {
    refuse(
        fmt::format("run.max_cycles = {} ends a run that takes cycles one after the other; set "
                    "it to 0, or run.fidelity to another than functional and analytic",
                    run.max_cycles));
  }
}

void check_view(const Config& c) {
  if (c.camera.position && c.camera.position == c.camera.look_at) {
    refuse("camera.position and camera.look_at are the same point; the camera needs a direction");
  }
  if (c.light.intensity && !c.light.position) {
    refuse("light.intensity belongs to the light of light.position, which is off; set both");
  }
}

}  // namespace

std::vector<std::string> heat_map_names(const ImageSpec& image) {
  std::vector<std::string> names;
  std::string_view rest = image.heat_maps;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string name(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    std::erase(name, ' ');
    if (name.empty()) continue;
    if (std::ranges::find(kHeatMaps, name) == kHeatMaps.end()) {
      refuse(fmt::format("image.heat_maps: unknown counter '{}'; known: {}", printable(name),
                         fmt::join(kHeatMaps, ", ")));
    }
    if (std::ranges::find(names, name) != names.end()) {
      refuse(fmt::format("image.heat_maps: '{}' stands there twice", name));
    }
    names.push_back(std::move(name));
  }
  return names;
}

void derive_capacities(Config& c) {
  for (CacheSpec* cache :
       {&c.node_cache, &c.triangle_cache, &c.attribute_cache, &c.texture_cache, &c.film_cache}) {
    if (cache->sets != 0) cache->capacity = cache->sets * cache->line * cache->ways;
  }
  if (c.l2.sets != 0) c.l2.capacity = c.l2.sets * c.l2.line * c.l2.ways * c.l2.banks;
}

void check_config(const Config& config) {
  check_memory(config);
  check_flow(config);
  check_view(config);
  check_run(config.run);
  static_cast<void>(heat_map_names(config.image));
}

}  // namespace sheaf
