// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sheaf {

enum class Align : bool { kLeft, kRight };

/// Text in aligned columns, for summaries.
class TextTable {
 public:
  /// A row of titles is optional; the number of columns is that of `alignment`.
  explicit TextTable(std::vector<Align> alignment) : alignment_(std::move(alignment)) {}

  /// Cells that are missing at the end of a row are empty; too many throw std::logic_error.
  void add_row(std::vector<std::string> cells);

  /// A line of dashes as wide as the table.
  void add_rule() { rows_.emplace_back(); }

  /// Each row on a line, `indent` spaces in, columns two spaces apart, nothing at line ends. Widths
  /// are code points, so that a "µ" counts once.
  [[nodiscard]] std::string text(std::size_t indent = 0) const;

 private:
  std::vector<Align> alignment_;
  std::vector<std::vector<std::string>> rows_;  ///< an empty row is a rule
};

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t value);

}  // namespace sheaf
