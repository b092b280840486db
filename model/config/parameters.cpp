// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/parameters.h"

#include "config/dram/parameters.h"

namespace sheaf {
namespace {

void declare_run(ParameterTable& t, Config& c) {
  t.choice(
      "run.fidelity", c.run.fidelity, Fidelity::kTimed,
      {{"functional", Fidelity::kFunctional},
       {"analytic", Fidelity::kAnalytic},
       {"sampled", Fidelity::kSampled},
       {"decoupled", Fidelity::kDecoupled},
       {"timed", Fidelity::kTimed},
       {"clocked", Fidelity::kClocked}},
      "How much of time is simulated: none (same pipeline, untimed); none, with bounds on the "
      "cycles from counts; a random sample of tiles; event-driven cycles with units that run "
      "ahead by run.quantum; event-driven cycles; or every unit ticking in every cycle, which is "
      "the reference and slow");
  t.count("run.quantum", c.run.quantum, 16, 0, kMaxLatency, "cycles",
          "decoupled: how much further units run ahead of each other than is exact");
  t.real("run.sample_share", c.run.sample_share, 0.1, 1e-6, 1.0, "1",
         "sampled: share of the tiles that is simulated in time");
  t.count("run.sample_seed", c.run.sample_seed, 1, 0, kMaxCount, "",
          "sampled: seed of the choice of tiles");
  t.count("run.max_cycles", c.run.max_cycles, 0, 0, kMaxCount, "cycles",
          "End a run in time, marked as partial, after this many cycles; 0 = no limit");
  t.flag("run.keep_all", c.run.keep_all, false,
         "Build every unit that the configuration allows, needed by the scene or not");
  t.count("image.width", c.image.width, 640, 1, 16384, "pixels", "Width of the picture");
  t.count("image.height", c.image.height, 480, 1, 16384, "pixels", "Height of the picture");
  t.text("image.heat_maps", c.image.heat_maps, "",
         "Per-pixel counters written as EXR layers, comma-separated: rays, node_visits, "
         "triangle_tests");
  t.real("render.weight_cutoff", c.render.weight_cutoff, 0.0, 0.0, 1.0, "1",
         "A ray whose largest weight component is at or below this is not spawned; 0 drops none "
         "but rays of weight zero");
  t.count("render.recursion_level", c.render.recursion_level, 1, 0, 100, "bounces",
          "Reflection and refraction rays are traced up to this depth");
  t.optional_real("scene.reflectance", c.scene.reflectance, 0.0, 1.0, "1",
                  "Gives every material this mirror weight; off keeps the scene's own");
  t.triple("scene.background", c.scene.background, {0.35, 0.45, 0.6}, 0.0, 1e30, "radiance",
           "Radiance that a ray leaving the scene brings back, linear RGB");
  t.text("camera.name", c.camera.name, "", "Camera of the scene to use; empty = the first");
  t.optional_triple("camera.position", c.camera.position, "scene units", "Overrides the camera");
  t.optional_triple("camera.look_at", c.camera.look_at, "scene units",
                    "Point at which an overridden camera looks; off = centre of the scene");
  t.optional_real("camera.yfov", c.camera.yfov, 1.0, 170.0, "degrees",
                  "Vertical field of view of the camera");
  t.optional_triple("light.position", c.light.position, "scene units",
                    "Replaces all lights by one white point light here");
  t.optional_real("light.intensity", c.light.intensity, 0.0, 1e30, "candela",
                  "Intensity of the light that light.position puts there; off = lights the scene's "
                  "centre like a sun of irradiance pi");
}

void declare_flow(ParameterTable& t, Config& c) {
  t.frequency("clock.frequency", c.clock.frequency, 1e9, 1e3, 1e12, "Core clock of the machine");
  t.count("packet.size", c.packet.size, 16, 1, 64, "rays", "Rays of a full packet");
  t.choice("traversal.scheme", c.traversal_scheme, Scheme::kMasked,
           {{"single", Scheme::kSingle},
            {"masked", Scheme::kMasked},
            {"interval", Scheme::kInterval},
            {"interval_entry", Scheme::kIntervalEntry},
            {"omni", Scheme::kOmni}},
           "How a packet walks the kd-tree: ray by ray; together with an active mask; with one "
           "interval for all of a direction octant, from the root or from an entry point searched "
           "first; or with an active mask in one pass, whatever the directions");
  t.choice("flow.control", c.flow.control, FlowPolicy::kTile,
           {{"tile", FlowPolicy::kTile},
            {"credits", FlowPolicy::kCredits},
            {"spill", FlowPolicy::kSpill}},
           "What keeps the spawned rays within bounds: finishing a tile before the next begins; "
           "admitting a primary packet only when its worst case fits; or moving what the queue "
           "before the ray cache cannot hold to memory and back");
  t.count("flow.tile_size", c.flow.tile_size, 16, 1, 1024, "pixels", "Side of a square tile");
  t.count("flow.credits", c.flow.credits, 0, 0, kMaxCount, "rays",
          "Worst-case rays that credits flow control admits; 0 = the worst case of one tile");
  t.count(
      "flow.spill_queue", c.flow.spill_queue, 128, 1, 65536, "rays",
      "Rays that spill flow control keeps on chip before the ray cache; the others go to memory");
  t.count("primary_source.interval", c.primary_source.interval, 4, 1, kMaxLatency, "cycles",
          "Cycles between two primary packets");
  t.choice("packet_arbiter.policy", c.packet_arbiter.policy, ArbiterPolicy::kAlternate,
           {{"alternate", ArbiterPolicy::kAlternate},
            {"primary_first", ArbiterPolicy::kPrimaryFirst},
            {"secondary_first", ArbiterPolicy::kSecondaryFirst}},
           "Which packet a free traversal context gets");
}

void declare_ray_cache(ParameterTable& t, Config& c) {
  t.text("ray_cache.heuristic", c.ray_cache.heuristic, "dir",
         "How rays are sorted: none, dir, mdir(x), fastpos, pos(x), opos, ray5d(x) or grid(x)");
  t.count("ray_cache.cells", c.ray_cache.cells, 0, 0, 65536, "cells",
          "Cells of the ray cache; 0 = as many as the heuristic has keys (dir and fastpos 8, "
          "mdir(x) x, ray5d(x) 6 * 32^x but at most 192, pos and grid 64)");
  t.optional_real("pos.relative", c.ray_cache.pos_relative, 0.0, 1.0, "1",
                  "The x of pos(x) as a fraction of the squared scene diagonal instead of squared "
                  "world units");
  t.choice("ray_cache.victim", c.ray_cache.victim, VictimPolicy::kFullest,
           {{"fullest", VictimPolicy::kFullest},
            {"oldest", VictimPolicy::kOldest},
            {"lru", VictimPolicy::kLru}},
           "Which cell is evicted when a ray needs a new one and none is free");
  t.choice("ray_cache.order", c.ray_cache.order, RayOrder::kArrival,
           {{"arrival", RayOrder::kArrival}, {"breadth_first", RayOrder::kBreadthFirst}},
           "When spawned rays are sorted: as they arrive; or held back, without bound but for flow "
           "control, until nothing else is left, and then kind by kind, shadow rays first");
  t.flag("ray_cache.group_by_kind", c.ray_cache.group_by_kind, false,
         "Keep reflections, refractions and shadow rays in cells apart; none always does");
  t.count("ray_cache.resident_voxels", c.ray_cache.resident_voxels, 4, 0, 1024, "voxels",
          "Voxels of grid(x) scheduled last that are taken to be in the caches");
  t.count("ray_cache.timeout", c.ray_cache.timeout, 0, 0, kMaxCount, "cycles",
          "A cell that has been open for longer leaves as a packet; 0 = never");
  t.count("ray_cache.rays_per_cycle", c.ray_cache.rays_per_cycle, 4, 1, 64, "rays",
          "Rays that the ray cache takes in a cycle");
  t.count("ray_cache.latency", c.ray_cache.latency, 4, 1, kMaxLatency, "cycles",
          "From a ray's arrival to its cell's departure at the earliest");
  t.count("packet_fifo.depth", c.packet_fifo.depth, 16, 1, kMaxLatency, "packets",
          "Packets that the FIFO between ray cache and arbiter holds");
  t.count("packet_fifo.latency", c.packet_fifo.latency, 2, 1, kMaxLatency, "cycles",
          "From a packet's entry into the FIFO to its exit at the earliest");
}

void declare_shader_cache(ParameterTable& t, Config& c) {
  t.count("shader_cache.cells", c.shader_cache.cells, 0, 0, 1024, "cells",
          "Cells of the shader cache, which sorts traced rays before they are shaded; 0 = none");
  t.choice("shader_cache.key", c.shader_cache.key, ShaderCacheKey::kMaterial,
           {{"material", ShaderCacheKey::kMaterial}, {"texture", ShaderCacheKey::kTexture}},
           "Rays of a cell met the same material, or materials of the same textures");
  t.count("shader_cache.rays_per_cycle", c.shader_cache.rays_per_cycle, 4, 1, 64, "rays",
          "Rays that the shader cache takes in a cycle");
}

void declare_unit(ParameterTable& t, const std::string& name, UnitSpec& spec,
                  const UnitSpec& defaults, const std::string& step) {
  t.count(name + ".count", spec.count, defaults.count, 1, 64, "units", "Number of these units");
  t.count(name + ".contexts", spec.contexts, defaults.contexts, 1, 64, "packets",
          "Packets in flight in one unit");
  t.count(name + ".lanes", spec.lanes, defaults.lanes, 1, 64, "lanes",
          "SIMD lanes; a packet takes ceil(packet.size / lanes) issue slots for " + step);
  t.count(name + ".initiation_interval", spec.initiation_interval, defaults.initiation_interval, 1,
          kMaxLatency, "cycles", "Cycles that one issue slot occupies the pipeline");
  t.count(name + ".latency", spec.latency, defaults.latency, 1, kMaxLatency, "cycles",
          "From the last slot's issue to the result, cache hit latency not included");
}

void declare_units(ParameterTable& t, Config& c) {
  declare_unit(t, "traversal_unit", c.traversal_unit,
               {.count = 2, .contexts = 8, .lanes = 8, .initiation_interval = 1, .latency = 4},
               "one kd-tree node");
  declare_unit(t, "intersection_unit", c.intersection_unit,
               {.count = 2, .contexts = 4, .lanes = 8, .initiation_interval = 1, .latency = 12},
               "one triangle");
  declare_unit(t, "shader_unit", c.shader_unit,
               {.count = 1, .contexts = 4, .lanes = 4, .initiation_interval = 4, .latency = 40},
               "one hit");
  t.count("link.latency", c.link.latency, 4, 1, kMaxLatency, "cycles",
          "Latency of every link between two units");
  t.count("link.depth", c.link.depth, 8, 1, kMaxLatency, "messages",
          "Messages that a link between two units holds, on the way and waiting");
  t.count("link.memory_latency", c.link.memory_latency, 8, 1, kMaxLatency, "cycles",
          "Latency of the link between a private cache and the L2, each way");
  t.bytes("link.memory_width", c.link.memory_width, 32, 1, 4096,
          "Bytes a cycle that the L2 returns to one private cache");
  t.choice("film.format", c.film.format, FilmFormat::kFloat,
           {{"unorm8", FilmFormat::kUnorm8},
            {"half", FilmFormat::kHalf},
            {"float", FilmFormat::kFloat},
            {"exact", FilmFormat::kExact}},
           "Number format in which a pixel's contributions are accumulated");
}

// So many lines of any size that no capacity wraps in 64 bits.
constexpr std::uint64_t kMostSets = std::uint64_t{1} << 26;

// What private caches and the L2 share.
template <typename Spec>
void declare_cache(ParameterTable& t, const std::string& name, Spec& spec, const Spec& defaults,
                   const std::string& meaning, Bytes smallest, const std::string& capacity,
                   const std::string& line) {
  t.choice(name + ".mode", spec.mode, CacheMode::kNormal,
           {{"normal", CacheMode::kNormal},
            {"perfect", CacheMode::kPerfect},
            {"absent", CacheMode::kAbsent}},
           meaning + ": normal, always hitting, or not there");
  t.bytes(name + ".capacity", spec.capacity, defaults.capacity, smallest, kMaxCacheBytes, capacity);
  t.bytes(name + ".line", spec.line, defaults.line, 16, 4096, line);
  t.count(name + ".sets", spec.sets, 0, 0, kMostSets, "sets",
          "Sets of a bank, a power of two, which then make the capacity; 0 = as the capacity has "
          "it");
  t.count(name + ".ways", spec.ways, defaults.ways, 1, 1024, "ways", "Associativity");
  t.choice(name + ".replacement", spec.replacement, defaults.replacement,
           {{"lru", Replacement::kLru},
            {"plru", Replacement::kPlru},
            {"fifo", Replacement::kFifo},
            {"random", Replacement::kRandom}},
           "Which line of a set leaves: the least recently used, about that one (a tree of bits), "
           "the one that came first, or any");
  t.count(name + ".seed", spec.seed, 1, 0, kMaxCount, "1", "Seed of random replacement");
  t.count(name + ".sectors", spec.sectors, defaults.sectors, 1, 32, "sectors",
          "Parts of a line that are fetched and written one by one; a power of two");
  t.count(name + ".mshr_targets", spec.mshr_targets, 0, 0, 4096, "accesses",
          "Accesses that can wait for one outstanding line; 0 = any number");
}

void declare_private_cache(ParameterTable& t, const std::string& name, CacheSpec& spec,
                           const CacheSpec& defaults, const std::string& meaning) {
  declare_cache(t, name, spec, defaults, meaning, 16, "Capacity of one instance",
                "Line size; a power of two");
  t.count(name + ".banks", spec.banks, 1, 1, 64, "banks",
          "Banks, interleaved by line; a power of two");
  t.count(name + ".ports", spec.ports, 1, 1, 64, "ports",
          "Look-ups that one bank takes in a cycle");
  t.count(name + ".mshrs", spec.mshrs, defaults.mshrs, 1, 4096, "lines",
          "Lines that can be outstanding at a time");
  t.count(name + ".hit_latency", spec.hit_latency, defaults.hit_latency, 1, kMaxLatency, "cycles",
          "Latency of a hit");
}

void declare_writes(ParameterTable& t, const std::string& name, WriteSpec& spec,
                    const WriteSpec& defaults, const std::string& allocate) {
  t.choice(name + ".write_policy", spec.policy, defaults.policy,
           {{"back", WritePolicy::kBack}, {"through", WritePolicy::kThrough}},
           "Written data go to the next level when their line leaves, or at once");
  t.flag(name + ".write_allocate", spec.allocate, defaults.allocate, allocate);
  t.count(name + ".write_buffer", spec.buffer, defaults.buffer, 0, 4096, "writes",
          "Writes under way to the next level at which no more accesses are taken; 0 = any number");
}

void declare_crossbar(ParameterTable& t, CrossbarSpec& spec) {
  t.bytes("crossbar.request_width", spec.request_width, 0, 0, 4096,
          "Bytes a cycle of written data from one private cache and into one bank of the L2; a "
          "read takes one cycle of both; 0 = any number of requests in any cycle");
  t.count("crossbar.depth", spec.depth, 0, 0, 4096, "requests",
          "Requests that wait before one bank of the L2, with a request_width; the next ones hold "
          "up their cache's later ones; 0 = any number");
  t.bytes("crossbar.response_width", spec.response_width, 0, 0, 4096,
          "Bytes a cycle that one bank of the L2 returns; 0 = any number");
}

void declare_private_caches(ParameterTable& t, Config& c) {
  const CacheSpec l1{.mode = CacheMode::kNormal,
                     .capacity = 16384,
                     .line = 64,
                     .ways = 4,
                     .mshrs = 8,
                     .hit_latency = 2};
  CacheSpec film = l1;
  film.capacity = 8192;
  declare_private_cache(t, "node_cache", c.node_cache, l1, "kd-tree nodes, one per traversal unit");
  declare_private_cache(t, "triangle_cache", c.triangle_cache, l1,
                        "Leaf lists and triangles, one per intersection unit");
  declare_private_cache(t, "attribute_cache", c.attribute_cache, l1,
                        "Vertex attributes and materials, one per shader unit");
  declare_private_cache(t, "texture_cache", c.texture_cache, l1, "Texels, one per shader unit");
  declare_private_cache(t, "film_cache", c.film_cache, film, "The film's pixels");
  declare_writes(t, "film_cache", c.film_cache.write, film.write,
                 "Keep a line that was fetched for an addition; otherwise it is written on as soon "
                 "as it has been added to, and nothing is kept");
}

void declare_l2(ParameterTable& t, L2Spec& l2) {
  const L2Spec defaults{.mode = CacheMode::kNormal, .capacity = 524288, .line = 64, .ways = 8};
  declare_cache(t, "l2", l2, defaults, "Shared second-level cache", 64, "Capacity over all banks",
                "Line size; a power of two, at least the largest private line");
  t.count("l2.banks", l2.banks, 4, 1, 64, "banks", "Banks, interleaved by line; a power of two");
  t.count("l2.ports", l2.ports, 1, 1, 64, "ports", "Requests that one bank takes in a cycle");
  t.count("l2.mshrs", l2.mshrs, 16, 1, 4096, "lines", "Lines outstanding in one bank");
  t.count("l2.hit_latency", l2.hit_latency, 12, 1, kMaxLatency, "cycles",
          "From a bank's acceptance to the data");
  declare_writes(t, "l2", l2.write, defaults.write,
                 "Give a place to a line that is written and not there, fetching it unless all of "
                 "it is written; otherwise the write goes on to DRAM");
}

void declare_memory(ParameterTable& t, Config& c) {
  declare_private_caches(t, c);
  declare_crossbar(t, c.crossbar);
  declare_l2(t, c.l2);
  declare_dram(t, c.dram);
}

void declare_tree_and_measures(ParameterTable& t, Config& c) {
  t.real("kdtree.traversal_cost", c.kdtree.traversal_cost, 15.0, 1e-3, 1e6, "cost",
         "SAH cost of visiting an inner node");
  t.real("kdtree.intersection_cost", c.kdtree.intersection_cost, 20.0, 1e-3, 1e6, "cost",
         "SAH cost of one triangle test");
  t.real("kdtree.empty_bonus", c.kdtree.empty_bonus, 0.8, 0.0, 1.0, "1",
         "Factor on the cost of a split that cuts off empty space");
  t.count("kdtree.max_depth", c.kdtree.max_depth, 0, 0, 64, "nodes",
          "Deepest path allowed; 0 = 8 + 1.3 log2(triangles)");
  t.flag("measure.coherence", c.measure.coherence, false,
         "Measure c_t and c_i in an untimed pass of single rays");
  t.choice("measure.scope", c.measure.scope, MeasureScope::kTile,
           {{"tile", MeasureScope::kTile}, {"frame", MeasureScope::kFrame}},
           "Set of rays over which distinct nodes and triangles are counted: a tile of primary "
           "pixels, or the frame");
}

}  // namespace

ParameterTable declare_parameters(Config& config) {
  ParameterTable table;
  declare_run(table, config);
  declare_flow(table, config);
  declare_ray_cache(table, config);
  declare_shader_cache(table, config);
  declare_units(table, config);
  declare_memory(table, config);
  declare_tree_and_measures(table, config);
  return table;
}

}  // namespace sheaf
