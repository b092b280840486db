// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/summary.h"

#include <fmt/format.h>

#include "report/energy_summary.h"
#include "report/table.h"
#include "stats/stall_account.h"

namespace sheaf {
namespace {

class Summary {
 public:
  explicit Summary(const SummaryInput& input) : in_(input) {}

  std::string text() {
    heading();
    rays();
    if (has("system.cycles")) {
      time();
      if (has("system.film.stall_cycles_busy")) stalls();
    }
    if (has("system.ray_cache.num_insertions")) ray_cache();
    coherence();
    if (has("system.dram.num_reads")) memory();
    text_ += summarize_energy(in_.stats);
    left_out();
    wall_time();
    return text_;
  }

 private:
  [[nodiscard]] bool has(const std::string& path) const { return in_.stats.find(path) != nullptr; }
  [[nodiscard]] std::string value(const std::string& path) const {
    const StatsEntry* entry = in_.stats.find(path);
    if (entry == nullptr) return "-";
    if (const auto* count = std::get_if<std::uint64_t>(&entry->value)) return grouped(*count);
    if (const auto* real = std::get_if<double>(&entry->value)) return fmt::format("{:.4g}", *real);
    if (const auto* text = std::get_if<std::string>(&entry->value)) return *text;
    return "-";
  }
  [[nodiscard]] std::uint64_t count(const std::string& path) const {
    return has(path) ? in_.stats.count(path) : 0;
  }
  void section(const std::string& title) { text_ += "\n" + title + "\n"; }
  void add(const TextTable& table) { text_ += table.text(2); }

  void heading() {
    text_ += fmt::format("{} · {} triangles · {} × {} · recursion level {} · {} · {}-ray packets\n",
                         value("run.scene"), value("scene.triangles"), in_.config.image.width,
                         in_.config.image.height, in_.config.render.recursion_level,
                         value("run.heuristic"), in_.config.packet.size);
    if (has("estimate.cycles.value")) {
      text_ += "ESTIMATE: not the whole frame was simulated in time\n";
    }
    if (!in_.complete) text_ += "PARTIAL: stopped before the frame was complete\n";
  }

  void rays() {
    section("Rays");
    TextTable table({Align::kLeft, Align::kRight, Align::kRight});
    table.add_row({"", "traced", "hit"});
    for (const char* kind : {"primary", "reflection", "refraction", "shadow"}) {
      std::uint64_t retired = 0;
      std::uint64_t hits = 0;
      for (std::uint32_t depth = 0; depth <= in_.config.render.recursion_level + 1; ++depth) {
        const std::string path = fmt::format("rays.{}.depth{}", kind, depth);
        retired += count(path + ".num_retired");
        hits += count(path + ".num_hits");
      }
      if (retired != 0) table.add_row({kind, grouped(retired), grouped(hits)});
    }
    table.add_row({"all", value("rays.num_retired"), value("rays.num_hits")});
    add(table);
  }

  void time() {
    section("Time");
    TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
    table.add_row({"length of the frame", value("system.cycles"), "cycles"});
    if (has("system.cycles_ci95_low")) {
      table.add_row({"95 % confidence", value("system.cycles_ci95_low"),
                     "to " + value("system.cycles_ci95_high") + " cycles"});
    }
    table.add_row({"frames per second", value("system.frames_per_second"),
                   fmt::format("at {:.4g} GHz", in_.config.clock.frequency * 1e-9)});
    table.add_row({"rays per cycle", value("system.rays_per_cycle"), ""});
    table.add_row({"most rays in flight", value("system.max_rays_in_flight"), "rays"});
    add(table);
  }

  void stalls() {
    section("What the cycles went to, in percent");
    TextTable table(
        {Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight, Align::kRight});
    table.add_row({"", "busy", "input", "memory", "blocked", "idle"});
    for (const StatsEntry& entry : in_.stats.entries()) {
      const std::string suffix = std::string(".") + std::string(kStallInfos[0].name);
      if (!entry.path.ends_with(suffix)) continue;
      const std::string unit = entry.path.substr(0, entry.path.size() - suffix.size());
      std::vector<std::string> row{unit.substr(unit.find('.') + 1)};
      for (const CounterInfo& info : kStallInfos) {
        const double share = 100.0 *
                             static_cast<double>(count(unit + "." + std::string(info.name))) /
                             static_cast<double>(count("system.cycles"));
        row.push_back(fmt::format("{:.1f}", share));
      }
      table.add_row(row);
    }
    add(table);
  }

  void ray_cache() {
    section("Ray cache");
    TextTable table({Align::kLeft, Align::kRight, Align::kLeft});
    const std::string path = "system.ray_cache.";
    table.add_row(
        {"hit rate", value(path + "hit_rate"),
         fmt::format("{} of {} rays", value(path + "num_hits"), value(path + "num_insertions"))});
    for (const auto& [what, key] :
         {std::pair{"left full", "full"}, std::pair{"left evicted", "evicted"},
          std::pair{"left timed out", "timed_out"}, std::pair{"swept, tile", "swept_tile"},
          std::pair{"swept, frame", "swept_frame"}, std::pair{"swept, stall", "swept_stall"}}) {
      const std::uint64_t packets = count(path + "num_packets_" + key);
      if (packets == 0) continue;
      const double fill =
          static_cast<double>(count(path + "num_rays_" + key)) / static_cast<double>(packets);
      table.add_row({what, grouped(packets), fmt::format("packets of {:.3g} rays", fill)});
    }
    table.add_row({"mean residence", value(path + "mean_cell_residence"), "cycles"});
    add(table);
  }

  void coherence() {
    section("Coherence");
    TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kRight});
    const bool measured = has("coherence.primary.c_t");
    table.add_row({"", "p_t", "p_i", measured ? "c_t" : "", measured ? "c_i" : ""});
    for (const std::string kind : {"primary", "secondary"}) {
      if (!has("trace." + kind + ".p_t")) continue;
      std::vector<std::string> row{kind, value("trace." + kind + ".p_t"),
                                   value("trace." + kind + ".p_i")};
      if (measured) {
        row.push_back(value("coherence." + kind + ".c_t"));
        row.push_back(value("coherence." + kind + ".c_i"));
      }
      table.add_row(row);
    }
    add(table);
  }

  /// Sums a cache's counter over the units that have one.
  [[nodiscard]] std::uint64_t sum(const std::string& unit, const std::string& counter) const {
    std::uint64_t total = 0;
    for (std::uint32_t i = 0; has(fmt::format("system.{}{}.{}", unit, i, counter)); ++i) {
      total += count(fmt::format("system.{}{}.{}", unit, i, counter));
    }
    return total;
  }
  void cache_row(TextTable& table, const std::string& name, std::uint64_t hits,
                 std::uint64_t accesses, std::uint64_t bytes) {
    if (accesses == 0) return;
    table.add_row(
        {name, grouped(accesses),
         fmt::format("{:.2f} %", 100.0 * static_cast<double>(hits) / static_cast<double>(accesses)),
         grouped(bytes)});
  }

  void memory() {
    section("Memory");
    TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight});
    table.add_row({"", "accesses", "hits", "bytes read below"});
    for (const auto& [unit, cache] :
         {std::pair{"traversal_unit", "node_cache"},
          std::pair{"intersection_unit", "triangle_cache"},
          std::pair{"shader_unit", "attribute_cache"}, std::pair{"shader_unit", "texture_cache"}}) {
      const std::string prefix = std::string(cache) + ".";
      cache_row(table, cache, sum(unit, prefix + "num_hits"), sum(unit, prefix + "num_accesses"),
                sum(unit, prefix + "bytes_read"));
    }
    cache_row(table, "film_cache", count("system.film.cache.num_hits"),
              count("system.film.cache.num_accesses"), count("system.film.cache.bytes_read"));
    cache_row(table, "l2", count("system.l2.num_hits"), count("system.l2.num_accesses"),
              count("system.l2.bytes_read"));
    add(table);
    TextTable dram({Align::kLeft, Align::kRight, Align::kLeft});
    dram.add_row({"DRAM bytes per ray", value("system.dram.bytes_per_ray"), ""});
    dram.add_row({"DRAM bus utilization", value("system.dram.bus_utilization"), ""});
    add(dram);
  }

  void left_out() {
    if (in_.plan.left_out.empty()) return;
    section("Left out");
    TextTable table({Align::kLeft, Align::kLeft});
    for (const auto& [what, why] : in_.plan.left_out) table.add_row({what, why});
    add(table);
  }

  void wall_time() {
    section("Wall time");
    text_ += fmt::format("  scene {:.2f} s, kd-tree {:.2f} s, simulation {:.2f} s: {:.3g} rays/s\n",
                         in_.wall.load, in_.wall.build, in_.wall.run,
                         static_cast<double>(count("rays.num_retired")) / in_.wall.run);
  }

  const SummaryInput& in_;
  std::string text_;
};

}  // namespace

std::string summarize(const SummaryInput& input) {
  return Summary(input).text();
}

}  // namespace sheaf
