// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sheaf::test {

struct PerfettoTrack {
  std::string name;
  std::string parent;  ///< empty: none
  bool counter = false;
};

struct PerfettoEvent {
  enum class Type : std::uint8_t { kBegin = 1, kEnd = 2, kInstant = 3, kValue = 4 };
  Type type{};
  std::uint64_t track = 0;
  std::uint64_t at = 0;
  std::string name;
  std::int64_t value = 0;
  std::uint64_t flow = 0;  ///< 0: none
  bool ends_flow = false;
};

/// A Perfetto trace of track events, as far as Sheaf writes them.
struct PerfettoTrace {
  std::map<std::uint64_t, PerfettoTrack> tracks;
  std::vector<PerfettoEvent> events;  ///< in the order of the file

  /// "unit/track" of an event.
  [[nodiscard]] std::string path(const PerfettoEvent& event) const;
};

/// Throws if the file is no such trace, names a track twice or an event names none.
[[nodiscard]] PerfettoTrace read_perfetto(const std::filesystem::path& file);

}  // namespace sheaf::test
