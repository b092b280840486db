// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sheaf {

/// A place on an axis where the number of triangles beside a sweeping plane changes, packed so that
/// the order of the integers is the order of the sweep: coordinate (32 bits, mapped to an
/// order-preserving integer), kind (2 bits), triangle (30 bits).
using SplitEvent = std::uint64_t;

/// In the order of the sweep at one coordinate (Wald and Havran 2006, section 4.2).
enum class EventKind : std::uint32_t {
  kEnd = 0,     ///< the triangle's box ends here
  kPlanar = 1,  ///< the box has no extent along the axis
  kStart = 2    ///< the box starts here
};

inline constexpr std::uint32_t kEventTriangleBits = 30;
inline constexpr std::uint32_t kMaxEventTriangle = (1U << kEventTriangleBits) - 1;

/// Maps a finite float to an integer of the same order; both zeros map to the same integer.
[[nodiscard]] inline std::uint32_t coordinate_key(float coordinate) {
  const auto bits = std::bit_cast<std::uint32_t>(coordinate + 0.0F);
  return bits ^ ((0U - (bits >> 31)) | 0x8000'0000U);
}
[[nodiscard]] inline float key_coordinate(std::uint32_t key) {
  return std::bit_cast<float>(key ^ (((key >> 31) - 1U) | 0x8000'0000U));
}

[[nodiscard]] inline SplitEvent make_event(float coordinate, EventKind kind,
                                           std::uint32_t triangle) {
  const std::uint32_t low = (static_cast<std::uint32_t>(kind) << kEventTriangleBits) | triangle;
  return (std::uint64_t{coordinate_key(coordinate)} << 32) | low;
}
[[nodiscard]] inline std::uint32_t event_key(SplitEvent event) {
  return static_cast<std::uint32_t>(event >> 32);
}
[[nodiscard]] inline EventKind event_kind(SplitEvent event) {
  return static_cast<EventKind>((event >> kEventTriangleBits) & 3U);
}
[[nodiscard]] inline std::uint32_t event_triangle(SplitEvent event) {
  return static_cast<std::uint32_t>(event) & kMaxEventTriangle;
}

/// The sorted events of one node on each axis. Every triangle of the node has a start and an end,
/// or one planar event, on every axis.
struct NodeEvents {
  std::array<std::span<SplitEvent>, 3> axis;
  std::size_t num_triangles = 0;
};

/// Room for the events of num_triangles triangles: two events on each of three axes, and one spare
/// slot an axis because the splitter writes before it knows whether an event belongs there.
[[nodiscard]] constexpr std::size_t node_events_room(std::size_t num_triangles) {
  return 3 * (2 * num_triangles + 1);
}

/// Lays empty lists, with the full room of an axis as their extent, over memory of
/// node_events_room(num_triangles) events.
[[nodiscard]] inline NodeEvents lay_node_events(SplitEvent* memory, std::size_t num_triangles) {
  const std::size_t room = 2 * num_triangles + 1;
  return {
      {std::span(memory, room), std::span(memory + room, room), std::span(memory + 2 * room, room)},
      num_triangles};
}

}  // namespace sheaf
