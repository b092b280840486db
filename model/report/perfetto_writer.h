// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/units.h"

namespace sheaf {

/// Writes a Perfetto trace (protos/perfetto/trace of google/perfetto: Trace, TracePacket,
/// TrackDescriptor, TrackEvent), a little at a time. Timestamps, which Perfetto takes for
/// nanoseconds, are cycles.
class PerfettoWriter {
 public:
  using Track = std::uint64_t;
  static constexpr Track kTop = 0;  ///< no parent

  explicit PerfettoWriter(const std::filesystem::path& path);

  Track add_track(std::string_view name, Track parent);
  /// A track of numbers.
  Track add_counter(std::string_view name, Track parent, std::string_view unit);

  /// `flow`: number of the packet that arrows lead along, 0 for none; `last`: they end here.
  void begin(Track track, Cycles at, std::string_view name, std::uint64_t flow = 0,
             bool last = false);
  void end(Track track, Cycles at);
  void instant(Track track, Cycles at, std::string_view name, std::uint64_t flow = 0);
  void value(Track track, Cycles at, std::uint64_t value);

  [[nodiscard]] std::uint64_t num_events() const { return num_events_; }

  /// Throws Error(kOutput) if not everything could be written.
  void close();

 private:
  struct Event {
    std::int32_t type = 0;
    std::string_view name;
    std::uint64_t flow = 0;
    bool last = false;
  };
  void add_event(Track track, Cycles at, const Event& event, const std::int64_t* value = nullptr);
  void add_packet(const std::string& packet);

  std::filesystem::path path_;
  std::ofstream file_;
  std::string buffer_, packet_, event_;  ///< reused
  Track num_tracks_ = 0;
  std::uint64_t num_events_ = 0;
  bool begun_ = false;
};

}  // namespace sheaf
