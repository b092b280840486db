// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/shader_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

DataKind ShaderUnit::kind_of(Phase phase) {
  return phase == Phase::kIndices  ? DataKind::kTriangle
         : phase == Phase::kTexels ? DataKind::kTexture
                                   : DataKind::kAttribute;
}

ShaderUnit::ShaderUnit(const sc_core::sc_module_name& name, const UnitSpec& spec, int packet_size,
                       const CacheSpec& attribute_cache, const CacheSpec* texture_cache,
                       const ShadedScene& scene, ClockDomain& domain, TimedOut<LineRequest>& memory,
                       std::uint16_t attribute_requester, std::uint16_t texture_requester)
    : MultiContextUnit(name, spec, packet_size, domain),
      in_packets("in_packets"),
      in_attribute_lines("in_attribute_lines"),
      in_texture_lines("in_texture_lines"),
      out_film("out_film"),
      out_bundles("out_bundles"),
      scene_(scene),
      attributes_(attribute_cache, memory, attribute_requester),
      attribute_fetcher_(attributes_),
      contexts_(spec.contexts) {
  scene.flow.bind_shader(inbox_);
  if (texture_cache != nullptr) {
    textures_.emplace(*texture_cache, memory, texture_requester);
    texture_fetcher_.emplace(*textures_);
  }
}

void ShaderUnit::end_of_elaboration() {
  packets_.bind(in_packets, inbox_);
  in_attribute_lines->set_consumer(inbox_);
  if (textures_) in_texture_lines->set_consumer(inbox_);
  attributes_.bind(inbox_);
  if (textures_) textures_->bind(inbox_);
  out_film->add_producer(inbox_);
  if (out_bundles.size() != 0) out_bundles->add_producer(inbox_);
}

Cycles ShaderUnit::accept_inputs(Cycles now) {
  const auto resume = [&](int context) { unpark(context, now); };
  while (in_attribute_lines->has_arrived(now)) {
    attribute_fetcher_.fill(in_attribute_lines->read(now), now, resume);
  }
  Cycles next = in_attribute_lines->next_arrival();
  if (textures_) {
    while (in_texture_lines->has_arrived(now)) {
      texture_fetcher_->fill(in_texture_lines->read(now), now, resume);
    }
    next = std::min(next, in_texture_lines->next_arrival());
  }
  RayPacket* packet = nullptr;
  while (has_free_context() && packets_.read(packet, now)) {
    accept_packet(packet, now);
    look_again();  // its credit may let the next one come
  }
  return has_free_context() ? std::min(next, packets_.next_arrival()) : next;
}

void ShaderUnit::accept_packet(RayPacket* packet, Cycles now) {
  const int number = take_context();
  Context& context = contexts_[static_cast<std::size_t>(number)];
  context.packet = packet;
  scene_.shader.shade(*packet, context.shading);
  if (recorder_ != nullptr) {
    recorder_->begin(number, packet->cause, packet->cause.sent + link_latency_, now);
  }
  begin_phase(number, Phase::kIndices);
  schedule(number, now);
}

// Skips the phases that have nothing to fetch.
void ShaderUnit::begin_phase(int number, Phase phase) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  context.phase = phase;
  context.issued = false;
  context.lines.clear();
  list_lines(context);
  if (context.lines.empty() && phase < Phase::kCompute) {
    begin_phase(number, static_cast<Phase>(static_cast<int>(phase) + 1));
  }
}

// Lines in ascending order, each once.
void ShaderUnit::list_lines(Context& context) {
  auto& lines = context.lines;
  list_addresses(context, lines);
  if (lines.empty()) return;  // such as texels where there are no textures, and no cache for them
  const PrivateCache& cache = context.phase == Phase::kTexels ? *textures_ : attributes_;
  for (std::uint64_t& line : lines) line = cache.line_of(line);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
}

// Of what the phase reads; the line that an address lies in is all that is fetched for it.
void ShaderUnit::list_addresses(const Context& context, std::vector<Address>& addresses) const {
  const MemoryMap& memory = scene_.memory;
  switch (context.phase) {
    case Phase::kIndices:
      for (const std::uint32_t triangle : context.shading.triangles) {
        addresses.push_back(memory.triangle_indices(triangle));
      }
      break;
    case Phase::kAttributes:
      for (const std::uint32_t triangle : context.shading.triangles) {
        for (const std::uint32_t vertex : scene_.scene.triangles[triangle]) {
          addresses.push_back(memory.vertex(vertex));
        }
        addresses.push_back(memory.material(scene_.scene.triangle_material[triangle]));
      }
      break;
    case Phase::kTexels:
      for (const TexelAccess& texel : context.shading.texels) {
        addresses.push_back(memory.texel(texel.texture, texel.x, texel.y));
      }
      break;
    case Phase::kCompute:
    case Phase::kOutput:
      break;
  }
}

bool ShaderUnit::ready(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase != Phase::kOutput && !context.issued) return true;
  if (context.phase < Phase::kCompute) {
    begin_phase(number, static_cast<Phase>(static_cast<int>(context.phase) + 1));
    return true;
  }
  if (context.phase == Phase::kCompute) prepare_output(context);
  send_output(number, now);
  return false;
}

void ShaderUnit::issue(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.phase == Phase::kCompute) {
    context.issued = true;
    if (recorder_ != nullptr) record_compute(number, now);
    const bool only_post = context.shading.triangles.empty();
    occupy(number, only_post ? 1 : slots_per_step_, 0, only_post ? slots_per_step_ : 0, now);
    return;
  }
  const bool texels = context.phase == Phase::kTexels;
  LineFetcher& fetcher = texels ? *texture_fetcher_ : attribute_fetcher_;
  if (recorder_ != nullptr && !fetcher.has_begun(number)) record_fetch(number, now);
  const DataKind kind = kind_of(context.phase);
  const auto line = [&](std::uint32_t i) { return context.lines[i]; };
  const auto outcome =
      fetcher.fetch(number, static_cast<std::uint32_t>(context.lines.size()), kind, line, now);
  if (outcome.complete) {
    context.issued = true;
    const Cycles hit_latency = texels ? textures_->hit_latency() : attributes_.hit_latency();
    occupy_fetch(number, hit_latency, outcome.port_cycles, now);
  } else {
    park(number, now);
    occupy_missed(outcome.port_cycles, now);
  }
}

void ShaderUnit::record_fetch(int number, Cycles now) {
  const Context& context = contexts_[static_cast<std::size_t>(number)];
  const bool texels = context.phase == Phase::kTexels;
  // What an address of the phase names, no more than its line: see list_addresses().
  const auto phase = static_cast<std::size_t>(context.phase);
  const std::uint32_t operation = recorder_->operation(phase, [&] {
    return MemoryOperation{.cache = static_cast<std::uint8_t>(texels ? 1 : 0),
                           .kind = kind_of(context.phase),
                           .bytes = MemoryMap::kTexelSize};
  });
  std::vector<Address> addresses;
  list_addresses(context, addresses);
  std::sort(addresses.begin(), addresses.end());
  addresses.erase(std::unique(addresses.begin(), addresses.end()), addresses.end());
  recorder_->step(number, operation, addresses[0], false, now);
  for (std::size_t i = 1; i < addresses.size(); ++i) {
    recorder_->also(number, operation, addresses[i], now);
  }
}

void ShaderUnit::record_compute(int number, Cycles now) {
  const bool only_post = contexts_[static_cast<std::size_t>(number)].shading.triangles.empty();
  const std::size_t key = static_cast<std::size_t>(Phase::kCompute) + (only_post ? 1 : 0);
  const std::uint32_t operation = recorder_->operation(key, [&] {
    const std::uint32_t whole = port_cycles(slots_per_step_);
    return MemoryOperation{
        .port_cycles = only_post ? std::max(port_cycles(1), slots_per_step_) : whole,
        .latency = step_latency()};
  });
  recorder_->step(number, operation, 0, true, now);
}

void ShaderUnit::prepare_output(Context& context) {
  context.phase = Phase::kOutput;
  PacketShading& shading = context.shading;
  if (!shading.contributions.empty()) {
    context.batch = scene_.batches.acquire();
    std::swap(*context.batch, shading.contributions);
  }
  if (!shading.spawned.rays.empty()) {
    context.bundle = scene_.bundles.acquire();
    std::swap(*context.bundle, shading.spawned);
  }
}

void ShaderUnit::send_output(int number, Cycles now) {
  Context& context = contexts_[static_cast<std::size_t>(number)];
  if (context.batch != nullptr) {
    if (!out_film->nb_write(context.batch, now)) {
      out_film->notify_when_free(inbox_);
      block(number);
      return;
    }
    context.batch = nullptr;
    if (recorder_ != nullptr) {
      recorder_->set_out(number, now);
      recorder_->recorder().send_to_film(recorder_->cause(number));
    }
  }
  if (context.bundle != nullptr && out_bundles->num_free(now) == 0) {
    out_bundles->notify_when_free(inbox_);
    block(number);
    return;
  }
  std::uint64_t spawned = 0;
  std::uint64_t reserved = 0;
  if (context.bundle != nullptr) {
    for (const Ray& ray : context.bundle->rays) {
      scene_.rays.spawn(ray.tag);
      reserved += scene_.flow.worst_case(ray.tag);
    }
    spawned = context.bundle->rays.size();
    if (recorder_ != nullptr) {
      recorder_->set_out(number, now);
      context.bundle->cause = recorder_->cause(number);
    }
    out_bundles->nb_write(context.bundle, now);
    context.bundle = nullptr;
  }
  unblock(number);
  if (recorder_ != nullptr) {
    recorder_->recorder().retire(recorder_->end(number, now));
  }
  look_again();
  retire(context, spawned, reserved, now);
  free_context(number);
  inbox_.set_next(std::min(inbox_.next(), std::max(packets_.next_arrival(), now + 1)));
}

void ShaderUnit::retire(Context& context, std::uint64_t spawned, std::uint64_t reserved_after,
                        Cycles now) {
  std::uint64_t reserved_before = 0;
  const RayPacket& packet = *context.packet;
  for (LaneMask left = packet.active; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    scene_.rays.retire(packet.tag[i], packet.hit_triangle[i] != kNoHit);
    reserved_before += scene_.flow.worst_case(packet.tag[i]);
  }
  const auto retired = static_cast<std::uint64_t>(std::popcount(packet.active));
  scene_.packets.release(context.packet);
  context.packet = nullptr;
  scene_.flow.replace(retired, spawned, reserved_before, reserved_after, now);
}

std::string ShaderUnit::stuck_reason() const {
  if (num_held() == 0) return {};
  return fmt::format("{}: {} packets held, {} waiting for memory, {} blocked by a full link",
                     name(), num_held(), std::popcount(parked()), std::popcount(blocked()));
}

}  // namespace sheaf
