// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "memory/memory_messages.h"
#include "sorting/spawn_bundle.h"
#include "units/clocked/link.h"
#include "units/clocked/unit.h"
#include "units/spill_unit.h"

namespace sheaf::clocked {

/// The bounded queue of spawned rays whose overflow goes to memory and comes back in order. In
/// every cycle, in this order,
///
///  1. lines that have come are taken in; bundles whose last one has come join the queue;
///  2. the first bundle of the queue goes on, if the link has room;
///  3. one line is asked for or written: of the bundle being read; else of the oldest in memory, if
///     it fits into the queue, where it gets its place now; else of the bundle being written;
///  4. a bundle is taken in, unless one is being written: into the queue if nothing that came
///     before it is elsewhere and it fits, or the queue is empty; else it will be written.
class SpillUnit final : public Unit {
 public:
  SpillUnit(std::string name, const sheaf::SpillUnit::Spec& spec, Link<LineRequest>& to_l2,
            Link<LineResponse>& from_l2)
      : Unit(std::move(name)),
        spec_(spec),
        to_l2_(to_l2),
        from_l2_(from_l2),
        next_address_(spec.base) {}

  Link<SpawnBundle*>* in_bundles = nullptr;
  Link<SpawnBundle*>* out_bundles = nullptr;

  [[nodiscard]] const SpillStats& stats() const { return stats_; }
  [[nodiscard]] Bytes line() const { return spec_.line; }
  [[nodiscard]] bool is_idle() const {
    return rays_queued_ + rays_in_memory_ + writing_.size() == 0;
  }

 private:
  struct Held {
    SpawnBundle* bundle = nullptr;
    Cycles arrival = 0;
    Cycles queued = 0;        ///< when it got its place in the queue
    Address address = 0;      ///< in memory
    std::uint64_t lines = 0;  ///< there
    std::uint64_t moved = 0;  ///< of these, written, or asked for
    std::uint64_t read = 0;   ///< of these, come back
    [[nodiscard]] std::uint64_t rays() const { return bundle->rays.size(); }
  };

  StallCause act(Cycles now) override;
  void take_lines(Cycles now);
  bool send_on(Cycles now);
  bool read_line(Cycles now);
  bool write_line(Cycles now);
  bool take_bundle(Cycles now);
  void give_place(Held& held, Cycles now);
  void request(Held& held, bool write, Cycles now);
  [[nodiscard]] bool fits(const Held& held) const {
    return rays_queued_ == 0 || rays_queued_ + held.rays() <= spec_.queue;
  }

  const sheaf::SpillUnit::Spec spec_;
  Link<LineRequest>& to_l2_;
  Link<LineResponse>& from_l2_;
  std::deque<Held> queue_;
  std::deque<Held> reading_;  ///< have a place in the queue, come back
  std::deque<Held> spilled_;  ///< in memory
  std::deque<Held> writing_;  ///< one at the most
  Address next_address_;
  std::uint64_t rays_queued_ = 0;     ///< in queue_ and reading_
  std::uint64_t rays_in_memory_ = 0;  ///< in spilled_ and reading_
  SpillStats stats_;
};

}  // namespace sheaf::clocked
