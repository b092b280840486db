// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/units.h"
#include "config/dram/device.h"

namespace sheaf {

/// Which rows are open in a channel, and the earliest cycle at which each command may be issued.
/// The rules are those of JESD79-4, section "Command timings": the same for the other standards as
/// far as they are modelled here.
class BankTiming {
 public:
  explicit BankTiming(const DramDevice& device);

  struct Bank {
    Cycles activate_at = 0;   ///< tRC, tRP, tRFC
    Cycles precharge_at = 0;  ///< tRAS, tRTP, tWR
    Cycles read_at = 0;       ///< tRCD
    Cycles write_at = 0;      ///< tRCDWR
    std::uint32_t row = 0;
    std::uint32_t rank = 0;
    std::uint32_t group = 0;  ///< in the channel
    bool open = false;
    bool fresh = false;         ///< opened and not yet read or written
    bool had_conflict = false;  ///< its last row was closed to make room for another
  };
  [[nodiscard]] Bank& bank(std::uint32_t index) { return banks_[index]; }
  [[nodiscard]] const Bank& bank(std::uint32_t index) const { return banks_[index]; }
  [[nodiscard]] std::uint32_t num_banks() const {
    return static_cast<std::uint32_t>(banks_.size());
  }
  [[nodiscard]] std::uint32_t num_groups() const {
    return static_cast<std::uint32_t>(groups_.size());
  }
  [[nodiscard]] std::uint32_t num_open(std::uint32_t rank) const { return ranks_[rank].num_open; }

  /// What holds for all banks of a rank, and what more for those of a group (numbered through the
  /// channel).
  [[nodiscard]] Cycles rank_activate_at(std::uint32_t rank) const {
    return ranks_[rank].activate_at;
  }
  [[nodiscard]] Cycles rank_column_at(std::uint32_t rank, bool write) const {
    return write ? ranks_[rank].write_at : ranks_[rank].read_at;
  }
  [[nodiscard]] Cycles group_activate_at(std::uint32_t group) const {
    return groups_[group].activate_at;
  }
  [[nodiscard]] Cycles group_column_at(std::uint32_t group, bool write) const {
    return write ? groups_[group].write_at : groups_[group].read_at;
  }
  /// When all banks of a rank may be closed together.
  [[nodiscard]] Cycles earliest_precharge_all(std::uint32_t rank) const;
  /// When a rank without open rows may be refreshed.
  [[nodiscard]] Cycles earliest_refresh(std::uint32_t rank) const;

  void activate(Bank& bank, std::uint32_t row, Cycles now);
  void precharge(Bank& bank, Cycles now);
  /// Closes the rank's open banks; returns how many there were.
  std::uint32_t precharge_all(std::uint32_t rank, Cycles now);
  void read(Bank& bank, Cycles now);
  void write(Bank& bank, Cycles now);
  /// The precharge that the device adds by itself to the column command just issued.
  void auto_precharge(Bank& bank);
  void refresh(std::uint32_t rank, Cycles now);

  /// Cycles up to `end` in which a rank had a row open, summed over ranks.
  [[nodiscard]] Cycles active_cycles(Cycles end) const;

 private:
  struct Group {
    Cycles activate_at = 0, read_at = 0, write_at = 0;
  };
  struct Rank {
    Cycles activate_at = 0;  ///< tRRD_S, tFAW
    Cycles read_at = 0, write_at = 0;
    std::array<Cycles, 4> activations{};  ///< the last four, as time + tFAW
    std::uint32_t oldest_activation = 0;
    std::uint32_t num_open = 0;
    // The time with rows open so far, and the stretch that is not yet in it.
    Cycles active = 0, active_since = 0, active_until = 0;
  };
  void close(Bank& bank, Cycles at);

  const DramTiming t_;
  std::uint32_t banks_per_rank_;
  std::vector<Bank> banks_;
  std::vector<Group> groups_;
  std::vector<Rank> ranks_;
};

}  // namespace sheaf
