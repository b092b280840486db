// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "system/memory_system.h"

#include <fmt/format.h>

#include "memory/banked_dram.h"
#include "memory/fixed_dram.h"

namespace sheaf {
namespace {

// MSHRs keep these links from filling up.
constexpr std::size_t kNeverFull = TimedChannel<LineRequest>::kUnbounded;

}  // namespace

sc_core::sc_time clock_period(const Config& config) {
  return {1.0 / config.clock.frequency, sc_core::SC_SEC};
}

MemorySystem::MemorySystem(const Config& config, ClockDomain& domain) : MemoryParts(config.link) {
  requests_.push_back(std::make_unique<TimedChannel<LineRequest>>(
      "caches_to_l2", TimedChannel<LineRequest>::Spec{
                          .capacity = kNeverFull, .latency = link_.memory_latency, .interval = 0}));
  l2_ = std::make_unique<L2Cache>("l2", config.l2, config.crossbar, domain);
  if (config.dram.model == DramModel::kFixed) {
    dram_ = std::make_unique<FixedDram>("dram", config.dram, domain);
  } else {
    auto banked = std::make_unique<BankedDram>("dram", resolve_dram(config.dram),
                                               config.clock.frequency, domain);
    l2_->expect_answers_from(banked->agent());
    dram_ = std::move(banked);
  }
  l2_->in_requests(*requests_.front());
  l2_->to_dram.bind(dram_->from_cache);
}

std::uint16_t MemorySystem::add_requester(Bytes bytes) {
  const auto number = static_cast<std::uint16_t>(lines_.size());
  lines_.push_back(std::make_unique<TimedChannel<LineResponse>>(
      fmt::format("l2_to_cache_{}", number).c_str(),
      TimedChannel<LineResponse>::Spec{
          .capacity = kNeverFull, .latency = link_.memory_latency, .interval = transfer(bytes)}));
  l2_->out_responses(*lines_.back());
  return number;
}

}  // namespace sheaf
