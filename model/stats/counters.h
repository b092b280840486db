// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sheaf {

/// Name, unit and meaning of one counter, declared once beside the unit that owns it.
struct CounterInfo {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
};

// SHEAF_STATS(Struct, LIST) declares a struct of 64-bit counters from one list of
// X(name, unit, meaning) lines: the members (all zero), their documentation and their enumeration.
#define SHEAF_STATS_MEMBER(name, unit, meaning) std::uint64_t name = 0;
#define SHEAF_STATS_INFO(name, unit, meaning) ::sheaf::CounterInfo{#name, unit, meaning},
#define SHEAF_STATS_VALUE(name, unit, meaning) f(::sheaf::CounterInfo{#name, unit, meaning}, name);
#define SHEAF_STATS_SUM(name, unit, meaning) name += other.name;
#define SHEAF_STATS(Struct, LIST)                                                                  \
  struct Struct {                                                                                  \
    LIST(SHEAF_STATS_MEMBER)                                                                       \
    [[nodiscard]] static std::span<const ::sheaf::CounterInfo> infos() {                           \
      static constexpr ::sheaf::CounterInfo kInfos[] = {LIST(SHEAF_STATS_INFO)};                   \
      return kInfos;                                                                               \
    }                                                                                              \
    template <typename F>                                                                          \
    void for_each(F&& f) const {LIST(SHEAF_STATS_VALUE)} Struct& operator+=(const Struct& other) { \
      LIST(SHEAF_STATS_SUM)                                                                        \
      return *this;                                                                                \
    }                                                                                              \
    [[nodiscard]] bool operator==(const Struct&) const = default;                                  \
  }

// SHEAF_VALUES(Struct, LIST) declares from such a list what is reported but not counted: a
// CounterInfo of each name.
#define SHEAF_VALUES_MEMBER(name, unit, meaning) \
  static constexpr ::sheaf::CounterInfo name{#name, unit, meaning};
#define SHEAF_VALUES(Struct, LIST)                                               \
  struct Struct {                                                                \
    LIST(SHEAF_VALUES_MEMBER)                                                    \
    [[nodiscard]] static std::span<const ::sheaf::CounterInfo> infos() {         \
      static constexpr ::sheaf::CounterInfo kInfos[] = {LIST(SHEAF_STATS_INFO)}; \
      return kInfos;                                                             \
    }                                                                            \
  }

}  // namespace sheaf
