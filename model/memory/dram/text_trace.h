// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.h"

namespace sheaf {

/// The last arrival that a memory driven alone takes, in tCK: weeks, and far enough below 2^64 that
/// times summed over all ranks of all channels, of which there are at most 1024, do not wrap.
inline constexpr Cycles kLastArrival = Cycles{1} << 52;

/// One line of a memory trace.
struct TraceAccess {
  Address address = 0;
  bool write = false;
  Cycles arrival = 0;  ///< tCK, up to kLastArrival
};

/// Reads a memory trace line by line, in DRAMsim3's form: address in hexadecimal, command, arrival
/// in memory cycles, separated by blanks:
///     0x2000D5C0 READ 30
/// Commands are READ and WRITE in any case, and DRAMsim3's further names P_FETCH, P_MEM_RD,
/// P_MEM_WR and BOFF. Blank lines and lines that begin with # are skipped. Arrivals must not go
/// back. Memory use does not depend on the length of the file.
class TextTrace {
 public:
  /// "-" is the standard input. Throws Error(kTrace) if the file cannot be read.
  explicit TextTrace(const std::string& path);

  /// False at the end. Throws Error(kTrace) naming file and line for whatever is no access.
  bool next(TraceAccess& access);

  [[nodiscard]] std::uint64_t num_lines() const { return line_; }

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  bool next_line(std::string_view& line);
  void parse(std::string_view line, TraceAccess& access) const;

  struct Close {
    void operator()(std::FILE* file) const;
  };
  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< unread part of the buffer
  bool at_end_ = false;
  std::uint64_t line_ = 0;
  Cycles last_arrival_ = 0;
};

}  // namespace sheaf
