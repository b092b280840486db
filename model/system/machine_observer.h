// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "channels/cycle_observer.h"
#include "memory/banked_dram.h"
#include "stats/stall_account.h"
#include "traversal/ray_packet.h"

namespace sheaf {

/// What a unit does in a cycle.
struct UnitState {
  StallCause cause{};
  std::uint64_t contexts = 0;  ///< bit i: context i is held
  bool issuing = false;        ///< its issue port is taken
};

struct UnitProbe {
  std::string name;
  std::uint32_t contexts = 0;  ///< 0: a unit without contexts
  std::function<UnitState(Cycles)> state;
  /// The packet that a held context works for; null if the unit has none.
  std::function<const RayPacket*(int context)> packet;
};

struct LinkProbe {
  std::string name;
  std::string reader;  ///< the unit at its end
  std::function<std::size_t(Cycles)> depth;
  // Only of links from where packets are made.
  std::function<std::uint64_t()> num_written;
  std::function<const RayPacket*(std::size_t)> from_back;  ///< 0: the one written last
};

struct LevelProbe {
  std::string name;
  std::string unit;
  std::function<std::uint64_t()> value;
};

/// What there is to be seen in a machine, valid as long as it. To be asked in observe() only.
struct MachineProbes {
  std::vector<UnitProbe> units;
  std::vector<LinkProbe> links;
  std::vector<LevelProbe> levels;
  BankedDram* dram = nullptr;  ///< null: memory without banks
};

/// Watches a machine run.
class MachineObserver : public CycleObserver {
 public:
  /// Before the run. Throws Error(kUsage) if the machine has not what is to be watched.
  virtual void attach(const MachineProbes& probes) = 0;
  /// After a run of `end` cycles.
  virtual void finish(Cycles end) = 0;
};

}  // namespace sheaf
