// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/machine_factors.h"

#include <fmt/format.h>

#include "stability/covering_array.h"

namespace sheaf::stability {
namespace {

using Strings = std::vector<std::string>;

Factor one_key(const std::string& key, const Strings& values) {
  Factor factor;
  for (const std::string& value : values)
    factor.levels.push_back({fmt::format("{}={}", key, value)});
  return factor;
}

class Factors {
 public:
  explicit Factors(const Extremes& extremes)
      : cycles_{"1", extremes.slow}, units_{"1", extremes.many}, clocks_(extremes.clocks) {}

  std::vector<Factor> all() {
    order_of_rays();
    units();
    links();
    for (const char* cache :
         {"node_cache", "triangle_cache", "attribute_cache", "texture_cache", "film_cache"}) {
      private_cache(cache);
    }
    writes("film_cache");
    l2();
    dram();
    return std::move(all_);
  }

 private:
  void add(const std::string& key, const Strings& values) { all_.push_back(one_key(key, values)); }

  void order_of_rays() {
    add("ray_cache.heuristic",
        {"none", "dir", "mdir(96)", "pos(1)", "opos", "grid(4)", "ray5d(1)"});
    add("ray_cache.timeout", {"0", "1", "1000000"});
    add("ray_cache.cells", {"1", "4096"});
    add("ray_cache.victim", {"fullest", "oldest", "lru"});
    add("ray_cache.order", {"arrival", "breadth_first"});
    add("ray_cache.group_by_kind", switch_);
    add("ray_cache.resident_voxels", {"0", "1024"});
    add("ray_cache.rays_per_cycle", {"1", "64"});
    add("ray_cache.latency", cycles_);
    add("shader_cache.cells", {"0", "1", "64"});
    add("shader_cache.key", {"material", "texture"});
    add("shader_cache.rays_per_cycle", {"1", "64"});
    add("flow.control", {"tile", "credits", "spill"});
    add("flow.tile_size", {"8", "1024"});
    add("flow.credits", {"0", "512"});  // a packet of the scene needs 448
    add("flow.spill_queue", {"1", "65536"});
  }

  void units() {
    add("traversal.scheme", {"single", "masked", "interval", "interval_entry", "omni"});
    add("clock.frequency", clocks_);
    add("packet.size", units_);
    add("packet_arbiter.policy", {"alternate", "primary_first", "secondary_first"});
    add("primary_source.interval", cycles_);
    for (const std::string unit : {"traversal_unit", "intersection_unit", "shader_unit"}) {
      for (const char* number : {"count", "contexts", "lanes"}) add(unit + "." + number, units_);
      add(unit + ".initiation_interval", cycles_);
      add(unit + ".latency", cycles_);
    }
  }

  void links() {
    add("packet_fifo.depth", depths_);
    add("packet_fifo.latency", cycles_);
    add("link.latency", cycles_);
    add("link.depth", depths_);
    add("link.memory_latency", cycles_);
    add("link.memory_width", {"1", "4096"});
    // Requests wait before a bank only where they have a width.
    all_.push_back({{{"crossbar.request_width=0"},
                     {"crossbar.request_width=1"},
                     {"crossbar.request_width=1", "crossbar.depth=1"}}});
    add("crossbar.response_width", {"0", "1"});
  }

  /// What private caches and the L2 share. Numbers of ways and sets are powers of two, so that any
  /// replacement and number of banks goes with them.
  void cache(const std::string& name) {
    add(name + ".mode", {"normal", "perfect", "absent"});
    add(name + ".sets", {"1", "64"});
    add(name + ".ways", {"1", "64"});
    add(name + ".replacement", {"lru", "plru", "fifo", "random"});
    add(name + ".ports", {"1", "64"});
    add(name + ".banks", units_);
    add(name + ".mshrs", lines_);
    add(name + ".mshr_targets", {"0", "1"});
    add(name + ".hit_latency", cycles_);
  }

  void private_cache(const std::string& name) {
    cache(name);
    add(name + ".sectors", {"1", "4"});
  }

  void writes(const std::string& name) {
    add(name + ".write_policy", {"back", "through"});
    add(name + ".write_allocate", switch_);
    add(name + ".write_buffer", {"0", "1"});
  }

  void l2() {
    cache("l2");
    writes("l2");
    // A sector must hold what a private cache asks for, which is 64 bytes.
    all_.push_back({{{"l2.line=64"}, {"l2.line=256", "l2.sectors=4"}}});
  }

  void dram() {
    add("dram.model", {"fixed", "DDR4-2400", "HBM2-2000"});
    add("dram.latency", cycles_);
    add("dram.bytes_per_cycle", {"1", "65536"});
    add("dram.channels", {"1", "2"});
    add("dram.ranks", {"1", "2"});
    add("dram.page", {"open", "closed"});
    add("dram.read_queue", {"1", "1024"});
    all_.push_back({{{"dram.write_queue=1", "dram.write_high=1", "dram.write_low=0"},
                     {"dram.write_queue=1024", "dram.write_high=1024", "dram.write_low=1023"}}});
    add("dram.row_hit_cap", {"0", "1000000"});
    add("dram.controller_latency", {"0", "1000"});
    add("dram.refresh", switch_);
  }

  const Strings switch_ = {"false", "true"};
  const Strings depths_ = {"1", "1000000"};
  const Strings lines_ = {"1", "4096"};
  Strings cycles_, units_, clocks_;
  std::vector<Factor> all_;
};

}  // namespace

std::vector<Factor> machine_factors(const Extremes& extremes) {
  return Factors(extremes).all();
}

std::vector<std::vector<std::string>> covering_machines(const std::vector<Factor>& factors,
                                                        std::size_t strength) {
  std::vector<std::size_t> levels;
  levels.reserve(factors.size());
  for (const Factor& factor : factors) levels.push_back(factor.levels.size());
  std::vector<Strings> machines;
  for (const auto& row : covering_array(levels, strength)) {
    Strings settings;
    for (std::size_t f = 0; f < factors.size(); ++f) {
      const Strings& chosen = factors[f].levels[row[f]];
      settings.insert(settings.end(), chosen.begin(), chosen.end());
    }
    machines.push_back(std::move(settings));
  }
  return machines;
}

}  // namespace sheaf::stability
