// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "sorting/kind_group.h"
#include "sorting/ray_sorter.h"

namespace sheaf {

/// opos: the paper's upper bound. Rays wait, unbounded, one list per direction-sign configuration
/// (and kind, if they are kept apart),
/// until nothing else is left to trace; then packets are formed from the first ray and those with
/// the nearest origins, until all have left. Rays that come later join the next round.
class OposSorter final : public RaySorter {
 public:
  OposSorter(bool by_kind, PacketPool& pool) : RaySorter(pool), by_kind_(by_kind) {}

  void insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) override;
  void sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) override;
  void time_out(Cycles /*opened_by*/, Cycles /*now*/,
                std::vector<RayPacket*>& /*departures*/) override {}
  [[nodiscard]] Cycles oldest_opening() const override { return kNever; }

 private:
  struct Waiting {
    Ray ray;
    Cycles arrival = 0;
  };
  void form_packets(std::vector<Waiting>& list, Departure why, Cycles now,
                    std::vector<RayPacket*>& departures);

  const bool by_kind_;
  std::array<std::vector<Waiting>, 8 * kNumKindGroups> lists_;
};

}  // namespace sheaf
