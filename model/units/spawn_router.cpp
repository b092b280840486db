// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/spawn_router.h"

#include <fmt/format.h>

#include <algorithm>

namespace sheaf {

SpawnRouter::SpawnRouter(const sc_core::sc_module_name& name, PacketPool& packets,
                         ObjectPool<SpawnBundle>& bundles, ClockDomain& domain)
    : sc_module(name),
      SteppingAgent(domain),
      in_bundles("in_bundles"),
      out_packets("out_packets"),
      packets_(packets),
      bundles_(bundles) {
  inbox_.bind(domain, domain.add(*this));
}

void SpawnRouter::end_of_elaboration() {
  in_bundles->set_consumer(inbox_);
  out_packets->add_producer(inbox_);
}

Cycles SpawnRouter::act(Cycles now) {
  if (waiting_.empty()) {
    if (!in_bundles->has_arrived(now)) {
      stalls_.switch_to(StallCause::kIdle, now);
      return in_bundles->next_arrival();
    }
    SpawnBundle* bundle = in_bundles->read(now);
    ++stats_.num_bundles;
    stats_.num_rays += bundle->rays.size();
    split_by_kind(*bundle, packets_, waiting_);
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      waiting_[i]->cause = bundle->cause;
      waiting_[i]->cause.sent = now + i + way_;
    }
    std::reverse(waiting_.begin(), waiting_.end());
    bundle->clear();
    bundles_.release(bundle);
  }
  if (!out_packets->nb_write(waiting_.back(), now)) {
    out_packets->notify_when_free(inbox_);
    stalls_.switch_to(StallCause::kBlockedOutput, now);
    return kNever;
  }
  waiting_.pop_back();
  ++stats_.num_packets;
  stalls_.switch_to(StallCause::kBusy, now);
  return now + 1;
}

std::string SpawnRouter::stuck_reason() const {
  if (waiting_.empty()) return {};
  return fmt::format("{}: {} packets blocked by a full FIFO", name(), waiting_.size());
}

}  // namespace sheaf
