// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/shader_unit.h"

#include <algorithm>
#include <bit>

namespace sheaf::clocked {

ShaderUnit::ShaderUnit(std::string name, const UnitSpec& spec, std::uint32_t packet_size,
                       const ShadedScene& scene, Cache attributes, std::optional<Cache> textures)
    : ContextUnit(std::move(name), spec, packet_size),
      scene_(scene),
      attributes_(std::move(attributes)),
      textures_(std::move(textures)),
      work_(spec.contexts) {}

void ShaderUnit::accept(Cycles now) {
  take_lines(attributes_, now);
  if (textures_) take_lines(*textures_, now);
  while (has_free_context() && in_packets.has_arrived(now)) {
    Work& w = work(take_context(now));
    w.packet = in_packets.read(now);
    scene_.shader.shade(*w.packet, w.shading);
    begin_phase(w, Phase::kIndices);
  }
}

// Skips the phases that have nothing to fetch.
void ShaderUnit::begin_phase(Work& w, Phase phase) {
  w.phase = phase;
  w.issued = false;
  w.lines.clear();
  list_lines(w);
  if (w.lines.empty() && phase < Phase::kCompute) {
    begin_phase(w, static_cast<Phase>(static_cast<int>(phase) + 1));
  }
}

void ShaderUnit::list_lines(Work& w) {
  const MemoryMap& memory = scene_.memory;
  if (w.phase == Phase::kIndices) {
    for (const std::uint32_t triangle : w.shading.triangles) {
      w.lines.push_back(attributes_.line_of(memory.triangle_indices(triangle)));
    }
  } else if (w.phase == Phase::kAttributes) {
    for (const std::uint32_t triangle : w.shading.triangles) {
      for (const std::uint32_t vertex : scene_.scene.triangles[triangle]) {
        w.lines.push_back(attributes_.line_of(memory.vertex(vertex)));
      }
      const std::uint32_t material = scene_.scene.triangle_material[triangle];
      w.lines.push_back(attributes_.line_of(memory.material(material)));
    }
  } else if (w.phase == Phase::kTexels) {
    for (const TexelAccess& texel : w.shading.texels) {
      w.lines.push_back(textures_->line_of(memory.texel(texel.texture, texel.x, texel.y)));
    }
  }
  std::sort(w.lines.begin(), w.lines.end());
  w.lines.erase(std::unique(w.lines.begin(), w.lines.end()), w.lines.end());
}

void ShaderUnit::resume(int context, Cycles now) {
  Work& w = work(context);
  if (w.phase == Phase::kOutput) return send_output(context, now);
  if (!w.issued) return enqueue(context);
  begin_phase(w, static_cast<Phase>(static_cast<int>(w.phase) + 1));
  if (w.phase != Phase::kOutput) return enqueue(context);
  w.has_batch = !w.shading.contributions.empty();
  send_output(context, now);
}

void ShaderUnit::issue(int context, Cycles now) {
  Work& w = work(context);
  const Cycles interval = spec_.initiation_interval;
  if (w.phase == Phase::kCompute) {
    w.issued = true;
    // A packet of shadow rays only adds: one slot, at least a cycle a slot of the packet.
    const bool only_adds = w.shading.triangles.empty();
    const Cycles all_slots = slots_per_step_;
    occupy(context, only_adds ? std::max(interval, all_slots) : all_slots * interval, spec_.latency,
           now);
    return;
  }
  const bool texels = w.phase == Phase::kTexels;
  const DataKind kind = w.phase == Phase::kIndices ? DataKind::kTriangle
                        : texels                   ? DataKind::kTexture
                                                   : DataKind::kAttribute;
  Cache& cache = texels ? *textures_ : attributes_;
  if (!fetch(context, cache, w.lines, kind, now)) return;
  w.issued = true;
  occupy(context, std::max<Cycles>(1, lookup_cycles()), cache.hit_latency(), now);
}

void ShaderUnit::send_output(int context, Cycles now) {
  Work& w = work(context);
  if (w.has_batch) {
    if (!out_film->has_room(now)) return block(context);
    FilmBatch* batch = scene_.batches.acquire();
    std::swap(*batch, w.shading.contributions);
    out_film->write(batch, now);
    w.has_batch = false;
  }
  const bool spawns = !w.shading.spawned.rays.empty();
  if (spawns && !out_bundles->has_room(now)) return block(context);
  retire(w, now);
  free(context);
}

void ShaderUnit::retire(Work& w, Cycles now) {
  std::uint64_t reserved_before = 0;
  std::uint64_t reserved_after = 0;
  for (LaneMask left = w.packet->active; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    scene_.rays.retire(w.packet->tag[i], w.packet->hit_triangle[i] != kNoHit);
    reserved_before += scene_.flow.worst_case(w.packet->tag[i]);
  }
  const std::uint64_t spawned = w.shading.spawned.rays.size();
  if (spawned != 0) {
    SpawnBundle* bundle = scene_.bundles.acquire();
    std::swap(*bundle, w.shading.spawned);
    for (const Ray& ray : bundle->rays) {
      scene_.rays.spawn(ray.tag);
      reserved_after += scene_.flow.worst_case(ray.tag);
    }
    out_bundles->write(bundle, now);
  }
  const auto retired = static_cast<std::uint64_t>(std::popcount(w.packet->active));
  scene_.packets.release(w.packet);
  scene_.flow.replace(retired, spawned, reserved_before, reserved_after, now);
}

}  // namespace sheaf::clocked
