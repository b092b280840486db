// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/object_pool.h"
#include "sorting/spawn_bundle.h"
#include "units/clocked/link.h"
#include "units/clocked/unit.h"
#include "units/spawn_router.h"

namespace sheaf::clocked {

/// Takes the ray cache's place for the heuristic `none`: what a packet spawned travels on as
/// packets by kind, one a cycle.
class SpawnRouter final : public Unit {
 public:
  SpawnRouter(std::string name, PacketPool& packets, ObjectPool<SpawnBundle>& bundles)
      : Unit(std::move(name)), packets_(packets), bundles_(bundles) {}

  Link<SpawnBundle*>* in_bundles = nullptr;
  Link<RayPacket*>* out_packets = nullptr;

  [[nodiscard]] const SpawnRouterStats& stats() const { return stats_; }

 private:
  StallCause act(Cycles now) override {
    if (waiting_.empty() && !in_bundles->has_arrived(now)) return StallCause::kIdle;
    if (waiting_.empty()) {
      SpawnBundle* bundle = in_bundles->read(now);
      ++stats_.num_bundles;
      stats_.num_rays += bundle->rays.size();
      split_by_kind(*bundle, packets_, waiting_);
      bundle->clear();
      bundles_.release(bundle);
    }
    if (!out_packets->write(waiting_.front(), now)) return StallCause::kBlockedOutput;
    waiting_.erase(waiting_.begin());
    ++stats_.num_packets;
    return StallCause::kBusy;
  }

  PacketPool& packets_;
  ObjectPool<SpawnBundle>& bundles_;
  std::vector<RayPacket*> waiting_;
  SpawnRouterStats stats_;
};

}  // namespace sheaf::clocked
