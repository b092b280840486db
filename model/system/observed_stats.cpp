// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/observed_stats.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>
#include <string_view>

namespace sheaf {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Where a total stands in a report: `unit` counts from 0 if it ends in a hyphen.
struct Source {
  Observed what;
  std::string_view unit;
  std::string_view counter;
};

constexpr std::array kSources{
    Source{Observed::kCycles, "system", "cycles"},
    Source{Observed::kDramBytes, "system.dram", "bytes_read"},
    Source{Observed::kDramBytes, "system.dram", "bytes_written"},
    Source{Observed::kNodeHits, "system.traversal_unit-", "node_cache.num_hits"},
    Source{Observed::kNodeAccesses, "system.traversal_unit-", "node_cache.num_accesses"},
    Source{Observed::kTriangleHits, "system.intersection_unit-", "triangle_cache.num_hits"},
    Source{Observed::kTriangleAccesses, "system.intersection_unit-", "triangle_cache.num_accesses"},
    Source{Observed::kAttributeHits, "system.shader_unit-", "attribute_cache.num_hits"},
    Source{Observed::kAttributeAccesses, "system.shader_unit-", "attribute_cache.num_accesses"},
    Source{Observed::kTextureHits, "system.shader_unit-", "texture_cache.num_hits"},
    Source{Observed::kTextureAccesses, "system.shader_unit-", "texture_cache.num_accesses"},
    Source{Observed::kFilmHits, "system.film", "cache.num_hits"},
    Source{Observed::kFilmAccesses, "system.film", "cache.num_accesses"},
    Source{Observed::kL2Hits, "system.l2", "num_hits"},
    Source{Observed::kL2Accesses, "system.l2", "num_accesses"},
    Source{Observed::kRayCacheHits, "system.ray_cache", "num_hits"},
    Source{Observed::kRayCacheInsertions, "system.ray_cache", "num_insertions"},
    Source{Observed::kPrimaryRayVisits, "trace.primary", "lane_inner_visits"},
    Source{Observed::kPrimaryPacketVisits, "trace.primary", "packet_inner_visits"},
    Source{Observed::kSecondaryRayVisits, "trace.secondary", "lane_inner_visits"},
    Source{Observed::kSecondaryPacketVisits, "trace.secondary", "packet_inner_visits"}};

double count_at(const StatsTree& stats, const std::string& path) {
  return stats.find(path) != nullptr ? static_cast<double>(stats.count(path)) : kNothing;
}

double sum_of(const StatsTree& stats, const Source& source) {
  if (!source.unit.ends_with('-')) {
    return count_at(stats, fmt::format("{}.{}", source.unit, source.counter));
  }
  const std::string_view unit = source.unit.substr(0, source.unit.size() - 1);
  const auto path = [&](int i) { return fmt::format("{}{}.{}", unit, i, source.counter); };
  double sum = count_at(stats, path(0));
  for (int i = 1; stats.find(path(i)) != nullptr; ++i) sum += count_at(stats, path(i));
  return sum;
}

double total(const StatsTree& stats, Observed what) {
  double sum = 0;
  for (const Source& source : kSources) {
    if (source.what == what) sum += sum_of(stats, source);
  }
  return sum;
}

std::optional<double> real_at(const StatsTree& stats, const std::string& path) {
  const StatsEntry* const entry = stats.find(path);
  const auto* const real = entry != nullptr ? std::get_if<double>(&entry->value) : nullptr;
  return real != nullptr ? std::optional(*real) : std::nullopt;
}

}  // namespace

Estimate observed(const StatsTree& stats, const Quantity& quantity) {
  const std::string path = fmt::format("estimate.{}.", quantity.info.name);
  if (stats.find(path + "value") != nullptr) {
    return {real_at(stats, path + "value").value_or(kNothing),
            real_at(stats, path + "ci95_low").value_or(kNothing),
            real_at(stats, path + "ci95_high").value_or(kNothing)};
  }
  const double per = quantity.per == Observed::kNone ? 1.0 : total(stats, quantity.per);
  return {total(stats, quantity.total) / per, kNothing, kNothing};
}

}  // namespace sheaf
