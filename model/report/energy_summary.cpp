// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/energy_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "report/table.h"

namespace sheaf {
namespace {

constexpr std::string_view kPrefix = "energy.";

constexpr std::size_t kWidth = 78;

/// A list with commas, on as many indented lines as it needs.
std::string wrapped(const std::string& list) {
  std::string text;
  std::string line = " ";
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    if (line.size() + 1 + end - at > kWidth) {
      text += line + '\n';
      line = "   ";
    }
    line += ' ' + list.substr(at, end - at);
    at = end + 1;
  }
  return text + line + '\n';
}

class EnergySummary {
 public:
  explicit EnergySummary(const StatsTree& stats) : stats_(stats) {}

  std::string text() {
    if (!real("energy.known")) return {};
    energy();
    if (count("area.ray_cache.bits")) ray_cache();
    return text_;
  }

 private:
  struct Unit {
    std::string name;
    double known = 0;
    bool any_known = false;
  };

  [[nodiscard]] std::optional<double> real(const std::string& path) const {
    const StatsEntry* entry = stats_.find(path);
    const auto* value = entry == nullptr ? nullptr : std::get_if<double>(&entry->value);
    return value == nullptr ? std::nullopt : std::optional(*value);
  }
  [[nodiscard]] std::optional<std::uint64_t> count(const std::string& path) const {
    const StatsEntry* entry = stats_.find(path);
    const auto* value = entry == nullptr ? nullptr : std::get_if<std::uint64_t>(&entry->value);
    return value == nullptr ? std::nullopt : std::optional(*value);
  }
  [[nodiscard]] std::string words(const std::string& path) const {
    return std::get<std::string>(stats_.find(path)->value);
  }
  [[nodiscard]] static std::string microjoule(double picojoule) {
    return fmt::format("{:.4g}", picojoule * 1e-6);
  }

  /// Items are energy.<unit>.<item>; they stand together by unit.
  [[nodiscard]] std::vector<Unit> units() const {
    std::vector<Unit> all;
    for (const StatsEntry& entry : stats_.entries()) {
      if (!entry.path.starts_with(kPrefix)) continue;
      const std::size_t dot = entry.path.find('.', kPrefix.size());
      if (dot == std::string::npos) continue;
      const std::string name = entry.path.substr(kPrefix.size(), dot - kPrefix.size());
      if (all.empty() || all.back().name != name) all.push_back({name});
      if (const auto* value = std::get_if<double>(&entry.value)) {
        all.back().known += *value;
        all.back().any_known = true;
      }
    }
    return all;
  }

  void energy() {
    const double known = *real("energy.known");
    text_ += fmt::format("\nEnergy and area of what is known, all but DRAM at {}\n",
                         words("energy.node"));
    TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
    for (const Unit& unit : units()) {
      if (!unit.any_known) continue;
      table.add_row({unit.name, microjoule(unit.known),
                     fmt::format("uJ  {:.1f} %", known > 0 ? 100 * unit.known / known : 0.0)});
    }
    table.add_row({"known", microjoule(known), "uJ a frame"});
    if (const auto ray = real("energy.per_ray")) {
      table.add_row({"", fmt::format("{:.4g}", *ray * 1e-3), "nJ a ray"});
    }
    if (const auto power = real("energy.power")) {
      table.add_row({"", fmt::format("{:.4g}", *power), "W at the clock of the run"});
    }
    table.add_row({"SRAM", grouped(*count("area.sram_bits")),
                   fmt::format("bits, {:.4g} mm2", *real("area.sram_mm2"))});
    text_ += table.text(2);
    text_ += wrapped("unknown: " + words("energy.unknown"));
    text_ += wrapped("no area of: " + words("area.unknown"));
  }

  // What one run can tell: the price, and how often a packet stood for several of its rays. What
  // sorting saves against not sorting is a difference of two runs.
  void ray_cache() {
    text_ += "\nRay cache: its price, and what its packets spare\n";
    TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
    const double all = static_cast<double>(*count("area.sram_bits"));
    const auto memory = [&](const char* what, const std::string& path) {
      if (!count(path + ".bits")) return;
      const std::uint64_t bits = *count(path + ".bits");
      table.add_row({what, grouped(bits),
                     fmt::format("bits, {:.4g} mm2, {:.1f} % of the SRAM", *real(path + ".mm2"),
                                 100 * static_cast<double>(bits) / all)});
    };
    memory("cells", "area.ray_cache");
    memory("queue before them", "area.spawned_rays");
    double spent = 0;
    for (const char* item : {"ray_cache.key", "ray_cache.cells", "spawned_rays.queue"}) {
      spent += real(fmt::format("energy.{}", item)).value_or(0);
    }
    table.add_row({"energy, known", microjoule(spent), "uJ"});
    for (const auto& [what, counter] : {std::pair{"node visits spared", "inner_visits"},
                                        std::pair{"triangle tests spared", "triangle_tests"}}) {
      const auto alone = count(fmt::format("trace.secondary.lane_{}", counter));
      const auto together = count(fmt::format("trace.secondary.packet_{}", counter));
      if (!alone || !together || *alone < *together) continue;
      table.add_row({what, grouped(*alone - *together),
                     fmt::format("of {} that its rays would make one by one", grouped(*alone))});
    }
    text_ += table.text(2);
    text_ +=
        "  cycles and DRAM bytes saved: not known from one run; compare system.cycles and\n"
        "  system.dram.bytes_read with those of ray_cache.heuristic=none\n";
  }

  const StatsTree& stats_;
  std::string text_;
};

}  // namespace

std::string summarize_energy(const StatsTree& stats) {
  return EnergySummary(stats).text();
}

}  // namespace sheaf
