// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/object_pool.h"
#include "sorting/ray_sorter.h"
#include "sorting/spawn_bundle.h"
#include "stats/stall_account.h"
#include "units/clocked/link.h"
#include "units/flow_control.h"

namespace sheaf::clocked {

/// Takes spawned rays in, several a cycle, and lets full, timed-out and swept cells leave. While a
/// packet waits to leave nothing else is done.
class RayCache {
 public:
  RayCache(std::string name, const RayCacheSpec& spec, std::unique_ptr<RaySorter> sorter,
           ObjectPool<SpawnBundle>& bundles, FlowControl& flow)
      : name_(std::move(name)),
        spec_(spec),
        sorter_(std::move(sorter)),
        bundles_(bundles),
        flow_(flow) {}

  Link<SpawnBundle*>* in_bundles = nullptr;
  Link<RayPacket*>* out_packets = nullptr;

  void tick(Cycles now);

  /// A cell will leave by and by, even if nothing else happens.
  [[nodiscard]] bool will_time_out() const { return next_time_out() != kNever; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const RaySorter& sorter() const { return *sorter_; }
  [[nodiscard]] const StallAccount& stalls() const { return stalls_; }
  void finish(Cycles end) { stalls_.finish(end); }

 private:
  [[nodiscard]] StallCause act(Cycles now);
  bool time_out(Cycles now);
  bool insert_rays(Cycles now);
  bool sweep(Cycles now);
  [[nodiscard]] Cycles next_time_out() const;

  const std::string name_;
  const RayCacheSpec spec_;
  std::unique_ptr<RaySorter> sorter_;
  ObjectPool<SpawnBundle>& bundles_;
  FlowControl& flow_;
  SpawnBundle* bundle_ = nullptr;  ///< being taken in
  std::size_t position_ = 0;
  std::vector<RayPacket*> departures_;
  StallAccount stalls_;
};

}  // namespace sheaf::clocked
