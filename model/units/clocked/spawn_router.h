// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/object_pool.h"
#include "sorting/spawn_bundle.h"
#include "stats/stall_account.h"
#include "units/clocked/link.h"
#include "units/spawn_router.h"

namespace sheaf::clocked {

/// Takes the ray cache's place for the heuristic `none`: what a packet spawned travels on as
/// packets by kind, one a cycle.
class SpawnRouter {
 public:
  SpawnRouter(std::string name, PacketPool& packets, ObjectPool<SpawnBundle>& bundles)
      : name_(std::move(name)), packets_(packets), bundles_(bundles) {}

  Link<SpawnBundle*>* in_bundles = nullptr;
  Link<RayPacket*>* out_packets = nullptr;

  void tick(Cycles now) { stalls_.switch_to(act(now), now); }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const SpawnRouterStats& stats() const { return stats_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  [[nodiscard]] StallCause act(Cycles now) {
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

  const std::string name_;
  PacketPool& packets_;
  ObjectPool<SpawnBundle>& bundles_;
  std::vector<RayPacket*> waiting_;
  SpawnRouterStats stats_;
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
