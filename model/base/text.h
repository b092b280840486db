// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sheaf {

/// `text` fit for a one-line message: control characters become '?', and what exceeds `limit` bytes
/// is cut off.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 120);

/// The width in columns of what the command prints for people.
constexpr std::size_t kLineWidth = 100;

/// Breaks `text` at spaces into lines that begin with `indent` and fit the line width, each with
/// its end of line. A longer word has a line of its own.
[[nodiscard]] std::string wrapped(std::string_view text, std::string_view indent);

/// Insertions, deletions, replacements and swaps of neighbours that make `b` of `a`, no letter
/// being edited twice (the restricted distance of Damerau and Levenshtein).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// Whether a known word at this distance from what was typed may have been meant: beyond a third
/// of its letters a guess helps nobody.
[[nodiscard]] bool may_be_meant(std::string_view typed, std::size_t distance);

}  // namespace sheaf
