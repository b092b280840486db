// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/units.h"
#include "config/dram/settings.h"

namespace sheaf {

// The structs below only hold values: names, defaults, ranges, units and meanings of all parameters
// are declared in parameters.cpp, and `sheaf config` prints them.

enum class Fidelity : std::uint8_t {
  kFunctional,
  kAnalytic,
  kSampled,
  kDecoupled,
  kTimed,
  kClocked
};
enum class Scheme : std::uint8_t { kSingle, kMasked, kInterval, kIntervalEntry, kOmni };
enum class FlowPolicy : std::uint8_t { kTile, kCredits, kSpill };
enum class VictimPolicy : std::uint8_t { kFullest, kOldest, kLru };
enum class RayOrder : std::uint8_t { kArrival, kBreadthFirst };
enum class ShaderCacheKey : std::uint8_t { kMaterial, kTexture };
enum class ArbiterPolicy : std::uint8_t { kAlternate, kPrimaryFirst, kSecondaryFirst };
enum class FilmFormat : std::uint8_t { kUnorm8, kHalf, kFloat, kExact };
enum class CacheMode : std::uint8_t { kNormal, kPerfect, kAbsent };
enum class Replacement : std::uint8_t { kLru, kPlru, kFifo, kRandom };
enum class WritePolicy : std::uint8_t { kBack, kThrough };
enum class MeasureScope : std::uint8_t { kTile, kFrame };

struct Triple {
  double x = 0, y = 0, z = 0;
  bool operator==(const Triple&) const = default;
};

struct RunSpec {
  Fidelity fidelity{};
  Cycles quantum{};
  double sample_share{};
  std::uint64_t sample_seed{};
  Cycles max_cycles{};
  bool keep_all{};
};

struct ImageSpec {
  std::uint32_t width{}, height{};
  std::string heat_maps;
};

struct SceneSpec {
  std::optional<double> reflectance;
  Triple background;
};

struct CameraSpec {
  std::string name;
  std::optional<Triple> position, look_at;
  std::optional<double> yfov;
};

struct LightSpec {
  std::optional<Triple> position;
  std::optional<double> intensity;
};

struct RenderSpec {
  std::uint32_t recursion_level{};
  double weight_cutoff{};
};

struct KdTreeSpec {
  double traversal_cost{}, intersection_cost{}, empty_bonus{};
  std::uint32_t max_depth{};
};

struct FlowSpec {
  FlowPolicy control{};
  std::uint32_t tile_size{};
  std::uint32_t credits{};
  std::uint32_t spill_queue{};  ///< rays
};

struct PacketSpec {
  std::uint32_t size{};
};

struct PrimarySourceSpec {
  Cycles interval{};
};

struct ArbiterSpec {
  ArbiterPolicy policy{};
};

struct RayCacheSpec {
  std::string heuristic;
  std::uint32_t cells{};
  std::optional<double> pos_relative;
  VictimPolicy victim{};
  RayOrder order{};
  bool group_by_kind{};
  std::uint32_t resident_voxels{};
  Cycles timeout{};
  std::uint32_t rays_per_cycle{};
  Cycles latency{};
};

struct ShaderCacheSpec {
  std::uint32_t cells{};
  ShaderCacheKey key{};
  std::uint32_t rays_per_cycle{};
};

struct PacketFifoSpec {
  std::uint32_t depth{};
  Cycles latency{};
};

/// Shared by the traversal, intersection and shader units.
struct UnitSpec {
  std::uint32_t count{};
  std::uint32_t contexts{};
  std::uint32_t lanes{};
  Cycles initiation_interval{};
  Cycles latency{};
};

struct LinkSpec {
  Cycles latency{};
  std::uint32_t depth{};
  Cycles memory_latency{};
  Bytes memory_width{};
};

/// What a cache does about writes.
struct WriteSpec {
  WritePolicy policy{};
  bool allocate{};
  std::uint32_t buffer{};  ///< writes that may be under way to the next level; 0: any number
};

/// A private cache. Once resolved, the capacity is that of all sets.
struct CacheSpec {
  CacheMode mode{};
  Bytes capacity{}, line{};
  std::uint32_t ways{}, banks{1}, mshrs{};
  Cycles hit_latency{};
  std::uint64_t sets{};  ///< 0: as the capacity has it
  std::uint32_t sectors{1}, ports{1};
  std::uint32_t mshr_targets{};  ///< 0: any number
  Replacement replacement{};
  std::uint64_t seed{};
  WriteSpec write{.policy = {}, .allocate = true, .buffer = {}};  ///< of the film's
};

/// The second level; sets, ports and MSHRs are those of one bank.
struct L2Spec {
  CacheMode mode{};
  Bytes capacity{}, line{};
  std::uint32_t ways{}, banks{1}, mshrs{};
  Cycles hit_latency{};
  std::uint64_t sets{};  ///< 0: as the capacity has it
  std::uint32_t sectors{1}, ports{1};
  std::uint32_t mshr_targets{};  ///< 0: any number
  Replacement replacement{};
  std::uint64_t seed{};
  WriteSpec write{};
};

/// Between the private caches and the banks of the L2; a width of 0 never holds anything up.
struct CrossbarSpec {
  Bytes request_width{};   ///< of written data, a cycle, from one cache and into one bank
  Bytes response_width{};  ///< a cycle, out of one bank
  std::uint32_t depth{};   ///< requests that wait before one bank; 0: any number
};

struct FilmSpec {
  FilmFormat format{};
};

struct MeasureSpec {
  bool coherence{};
  MeasureScope scope{};
};

struct ClockSpec {
  double frequency{};
};

/// Every parameter of a run, resolved and checked.
struct Config {
  RunSpec run;
  ImageSpec image;
  SceneSpec scene;
  CameraSpec camera;
  LightSpec light;
  RenderSpec render;
  KdTreeSpec kdtree;
  ClockSpec clock;
  FlowSpec flow;
  PacketSpec packet;
  Scheme traversal_scheme{};
  PrimarySourceSpec primary_source;
  ArbiterSpec packet_arbiter;
  RayCacheSpec ray_cache;
  PacketFifoSpec packet_fifo;
  ShaderCacheSpec shader_cache;
  UnitSpec traversal_unit, intersection_unit, shader_unit;
  LinkSpec link;
  CrossbarSpec crossbar;
  CacheSpec node_cache, triangle_cache, attribute_cache, texture_cache, film_cache;
  L2Spec l2;
  DramSpec dram;
  FilmSpec film;
  MeasureSpec measure;
};

}  // namespace sheaf
