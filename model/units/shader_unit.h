// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/object_pool.h"
#include "kdtree/memory_map.h"
#include "shading/packet_shader.h"
#include "tracefile/memory_recorder.h"
#include "traversal/packet_pool.h"
#include "units/flow_control.h"
#include "units/line_fetcher.h"
#include "units/link_choice.h"
#include "units/messages.h"
#include "units/multi_context_unit.h"
#include "units/ray_counts.h"

namespace sheaf {

using FilmBatch = std::vector<PixelContribution>;

/// What the shader units share.
struct ShadedScene {
  const Scene& scene;
  ShadingSource& shader;
  const MemoryMap& memory;
  PacketPool& packets;
  ObjectPool<SpawnBundle>& bundles;
  ObjectPool<FilmBatch>& batches;
  RayCounts& rays;
  FlowControl& flow;
};

/// Shades traced packets: reads the vertex numbers of the triangles that were hit, then vertices
/// and materials, then texels (each of these steps asks for all its lines at once), then computes.
/// Contributions go to the film; spawned rays go back into the loop as one bundle, so that a
/// packet's rays arrive together. A packet of shadow rays only adds, and is computed at one slot a
/// cycle.
class ShaderUnit final : public MultiContextUnit<ShaderUnit> {
 public:
  /// `texture_cache`: null if the scene has no textures.
  ShaderUnit(const sc_core::sc_module_name& name, const UnitSpec& spec, int packet_size,
             const CacheSpec& attribute_cache, const CacheSpec* texture_cache,
             const ShadedScene& scene, ClockDomain& domain, TimedOut<LineRequest>& memory,
             std::uint16_t attribute_requester, std::uint16_t texture_requester);

  sc_core::sc_port<TimedIn<RayPacket*>, 0> in_packets;  ///< one per traversal unit
  sc_core::sc_port<TimedIn<LineResponse>> in_attribute_lines;
  sc_core::sc_port<TimedIn<LineResponse>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> in_texture_lines;
  sc_core::sc_port<TimedOut<FilmBatch*>> out_film;
  /// Unbound if nothing in the scene spawns a ray.
  sc_core::sc_port<TimedOut<SpawnBundle*>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> out_bundles;

  /// The packet of a context that is held.
  [[nodiscard]] const RayPacket* packet(int context) const {
    return contexts_[static_cast<std::size_t>(context)].packet;
  }
  [[nodiscard]] const PrivateCache& attribute_cache() const { return attributes_; }
  [[nodiscard]] PrivateCache& attribute_cache() { return attributes_; }
  /// Null if the scene has no textures.
  [[nodiscard]] const PrivateCache* texture_cache() const {
    return textures_ ? &*textures_ : nullptr;
  }
  [[nodiscard]] PrivateCache* texture_cache() { return textures_ ? &*textures_ : nullptr; }
  [[nodiscard]] std::string stuck_reason() const override;

  /// Has all its steps taken down; packets come `link_latency` after they are sent.
  void record_to(StreamRecorder& recorder, Cycles link_latency) {
    recorder_ = &recorder;
    link_latency_ = link_latency;
  }

 private:
  friend class MultiContextUnit<ShaderUnit>;
  enum class Phase : std::uint8_t { kIndices, kAttributes, kTexels, kCompute, kOutput };
  struct Context {
    RayPacket* packet = nullptr;
    PacketShading shading;
    std::vector<std::uint64_t> lines;  ///< of the current phase, each once
    Phase phase = Phase::kIndices;
    bool issued = false;            ///< the phase's step is in the pipeline
    FilmBatch* batch = nullptr;     ///< still to be sent
    SpawnBundle* bundle = nullptr;  ///< still to be sent
  };

  [[nodiscard]] static DataKind kind_of(Phase phase);
  void end_of_elaboration() override;
  Cycles accept_inputs(Cycles now);
  void accept_packet(RayPacket* packet, Cycles now);
  bool ready(int context, Cycles now);
  void issue(int context, Cycles now);
  // Never runs ahead: it changes what flow control counts.
  [[nodiscard]] static Cycles earliest_input() { return 0; }
  void begin_phase(int number, Phase phase);
  void list_lines(Context& context);
  void list_addresses(const Context& context, std::vector<Address>& addresses) const;
  void record_fetch(int number, Cycles now);
  void record_compute(int number, Cycles now);
  void prepare_output(Context& context);
  void send_output(int context, Cycles now);
  void retire(Context& context, std::uint64_t spawned, std::uint64_t reserved_after, Cycles now);

  const ShadedScene scene_;
  MergedInput<RayPacket*> packets_;
  PrivateCache attributes_;
  LineFetcher attribute_fetcher_;
  std::optional<PrivateCache> textures_;
  std::optional<LineFetcher> texture_fetcher_;
  std::vector<Context> contexts_;
  StreamRecorder* recorder_ = nullptr;
  Cycles link_latency_ = 0;
};

}  // namespace sheaf
