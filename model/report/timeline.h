// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "report/dram_tracks.h"
#include "report/perfetto_writer.h"
#include "report/watch_window.h"
#include "system/machine_observer.h"

namespace sheaf {

/// Writes what a machine does as a Perfetto trace: for each unit what its cycles go to (idle cycles
/// are gaps), a track for each of its contexts with the packets they hold, as arrows from where a
/// packet was made to where it is shaded; the depth of its links and the rays that wait in it; for
/// each DRAM bank its open rows, for each channel its bursts. Memory is bounded, and so is the
/// file, by the window. What is open at the end of a recorded stretch is cut there.
class Timeline final : public MachineObserver {
 public:
  Timeline(const std::filesystem::path& path, const WatchWindow& window);

  void attach(const MachineProbes& probes) override;
  [[nodiscard]] Cycles next_observed(Cycles cycle) override;
  void observe(Cycles cycle) override;
  /// Throws Error(kOutput) if the file could not be written.
  void finish(Cycles end) override;

  /// The cycle at which there were enough events.
  [[nodiscard]] std::optional<Cycles> cut_at() const { return cut_at_; }

 private:
  using Track = PerfettoWriter::Track;
  struct Slot {  ///< a context
    Track track = 0;
    bool open = false;
  };
  struct Unit {
    UnitProbe probe;
    Track track = 0;
    StallCause cause = StallCause::kIdle;
    std::vector<Slot> slots;
    std::uint64_t held = 0;
    bool ends_flows = false;
  };
  struct Level {
    Track track = 0;
    std::function<std::uint64_t(Cycles)> value;
    std::optional<std::uint64_t> last;
  };
  struct Source {  ///< a link from where packets are made
    Track track = 0;
    LinkProbe probe;
    std::uint64_t written = 0;
  };

  void add_unit(const UnitProbe& probe);
  void add_link(const LinkProbe& probe);
  void show_cause(Unit& unit, StallCause cause, Cycles cycle);
  void show_contexts(Unit& unit, std::uint64_t held, Cycles cycle);
  void show_levels(Cycles cycle);
  void show_new_packets(Source& source, Cycles cycle);
  void close_open(Cycles at);
  [[nodiscard]] std::uint64_t flow_of(const RayPacket* packet);
  [[nodiscard]] Track track_of(const std::string& unit) const;

  const WatchWindow window_;
  PerfettoWriter writer_;
  std::vector<Unit> units_;
  std::vector<Level> levels_;
  std::vector<Source> sources_;
  std::unordered_map<const RayPacket*, std::uint64_t> flows_;  ///< of packets in flight
  std::uint64_t num_flows_ = 0;
  std::optional<DramTracks> dram_;
  std::optional<Cycles> last_;  ///< the cycle observed last, while a stretch is open
  std::optional<Cycles> cut_at_;
};

}  // namespace sheaf
