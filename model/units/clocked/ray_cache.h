// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/object_pool.h"
#include "sorting/ray_sorter.h"
#include "sorting/spawn_bundle.h"
#include "units/clocked/link.h"
#include "units/clocked/unit.h"
#include "units/flow_control.h"

namespace sheaf::clocked {

/// Takes spawned rays in, several a cycle, and lets full, timed-out and swept cells leave. While a
/// packet waits to leave nothing else is done.
class RayCache final : public Unit {
 public:
  RayCache(std::string name, RayCacheSpec spec, std::unique_ptr<RaySorter> sorter,
           ObjectPool<SpawnBundle>& bundles, FlowControl& flow)
      : Unit(std::move(name)),
        spec_(std::move(spec)),
        sorter_(std::move(sorter)),
        bundles_(bundles),
        flow_(flow) {}

  Link<SpawnBundle*>* in_bundles = nullptr;
  Link<RayPacket*>* out_packets = nullptr;

  /// A cell will leave by and by, even if nothing else happens.
  [[nodiscard]] bool will_time_out() const { return next_time_out() != kNever; }
  [[nodiscard]] const RaySorter& sorter() const { return *sorter_; }

 private:
  StallCause act(Cycles now) override;
  bool time_out(Cycles now);
  bool insert_rays(Cycles now);
  bool sweep(Cycles now);
  [[nodiscard]] Cycles next_time_out() const;

  const RayCacheSpec spec_;
  std::unique_ptr<RaySorter> sorter_;
  ObjectPool<SpawnBundle>& bundles_;
  FlowControl& flow_;
  SpawnBundle* bundle_ = nullptr;  ///< being taken in
  std::size_t position_ = 0;
  std::vector<RayPacket*> departures_;
};

}  // namespace sheaf::clocked
