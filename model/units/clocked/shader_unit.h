// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "units/clocked/context_unit.h"
#include "units/shader_unit.h"

namespace sheaf::clocked {

/// Shades traced packets: fetches vertex numbers, then vertices and materials, then texels (each
/// only if there are any), computes, and sends contributions to the film and spawned rays back into
/// the loop.
class ShaderUnit final : public ContextUnit {
 public:
  ShaderUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size,
             const ShadedScene& scene, Cache attributes, std::optional<Cache> textures);

  Inputs<RayPacket*> in_packets;  ///< one per traversal unit, or one of the shader cache
  Link<FilmBatch*>* out_film = nullptr;
  Link<SpawnBundle*>* out_bundles = nullptr;  ///< null if nothing in the scene spawns a ray

  [[nodiscard]] const Cache& attribute_cache() const { return attributes_; }
  /// Null if the scene has no textures.
  [[nodiscard]] const Cache* texture_cache() const { return textures_ ? &*textures_ : nullptr; }

 private:
  enum class Phase : std::uint8_t { kIndices, kAttributes, kTexels, kCompute, kOutput };
  struct Work {
    RayPacket* packet = nullptr;
    PacketShading shading;
    std::vector<std::uint64_t> lines;  ///< of the phase, each once
    Phase phase = Phase::kIndices;
    bool issued = false;     ///< the phase's step is in the pipeline
    bool has_batch = false;  ///< contributions are still to be sent
  };
  void accept(Cycles now) override;
  void resume(int context, Cycles now) override;
  void issue(int context, Cycles now) override;
  void begin_phase(Work& work, Phase phase);
  void list_lines(Work& work);
  void send_output(int context, Cycles now);
  void retire(Work& work, Cycles now);
  [[nodiscard]] Work& work(int context) { return work_[static_cast<std::size_t>(context)]; }

  const ShadedScene scene_;
  Cache attributes_;
  std::optional<Cache> textures_;
  std::vector<Work> work_;
};

}  // namespace sheaf::clocked
