// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/clocked_memory.h"

#include <fmt/format.h>

#include "config/dram/device.h"

namespace sheaf {

using clocked::Link;

ClockedMemory::ClockedMemory(const Config& config) : MemoryParts(config.link) {
  if (config.dram.model == DramModel::kFixed) {
    dram_ = std::make_unique<clocked::FixedDram>(config.l2.hit_latency, config.dram);
  } else {
    dram_ = std::make_unique<clocked::BankedDram>(config.l2.hit_latency, resolve_dram(config.dram),
                                                  config.clock.frequency);
  }
  l2_ = std::make_unique<clocked::L2Cache>(config.l2, config.crossbar, *dram_);
}

ClockedMemory::Requester ClockedMemory::add_requester(Bytes bytes) {
  const auto number = static_cast<std::uint16_t>(requests_.size());
  const Cycles latency = link_.memory_latency;
  requests_.push_back(std::make_unique<Link<LineRequest>>(
      fmt::format("cache_{}_to_l2", number),
      Link<LineRequest>::Spec{.latency = latency, .interval = 0}));
  lines_.push_back(std::make_unique<Link<LineResponse>>(
      fmt::format("l2_to_cache_{}", number),
      Link<LineResponse>::Spec{.latency = latency, .interval = transfer(bytes)}));
  l2_->in_requests.push_back(requests_.back().get());
  l2_->out_responses.push_back(lines_.back().get());
  return {number, *requests_.back(), *lines_.back()};
}

clocked::Cache ClockedMemory::make_cache(const CacheSpec& spec) {
  const Requester requester = add_requester(spec.line / spec.sectors);
  return {spec, requester.number, requester.requests, requester.lines};
}

void ClockedMemory::tick(Cycles now) {
  l2_->tick(now);
  dram_->tick(now);
}

void ClockedMemory::drain(Cycles now) {
  for (; !dram_->is_idle(); ++now) dram_->tick(now);
}

}  // namespace sheaf
