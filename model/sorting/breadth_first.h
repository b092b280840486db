// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sorting/ray_sorter.h"

namespace sheaf {

/// Breadth-first order (Nakamaru and Ohno, "Breadth-first ray tracing utilizing uniform spatial
/// subdivision", 1997): rays are held back until nothing else is left to trace, then go through
/// another sorter and leave, one kind of one depth at a time: the shadow rays, then the
/// reflections, then the refractions of the least depth that waits.
class BreadthFirstSorter final : public RaySorter {
 public:
  BreadthFirstSorter(std::unique_ptr<RaySorter> sorter, PacketPool& pool)
      : RaySorter(pool), sorter_(std::move(sorter)) {}

  void insert(const Ray& ray, Cycles now, std::vector<RayPacket*>& departures) override;
  void sweep(Departure why, Cycles now, std::vector<RayPacket*>& departures) override;
  void time_out(Cycles /*opened_by*/, Cycles /*now*/,
                std::vector<RayPacket*>& /*departures*/) override {}
  [[nodiscard]] Cycles oldest_opening() const override { return kNever; }

 private:
  using Wave = std::pair<std::uint32_t, std::uint32_t>;  ///< depth, rank of the kind

  std::unique_ptr<RaySorter> sorter_;  ///< empty but during a sweep
  std::map<Wave, std::vector<Ray>> held_;
};

}  // namespace sheaf
