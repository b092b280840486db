// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <stdexcept>

#include "image/rows.h"

namespace sheaf {

/// The rows of an image that lies in memory row by row. Throws std::logic_error for a row that is
/// not in it.
template <typename T>
[[nodiscard]] RowSource<T> rows_of(std::span<const T> pixels) {
  return [pixels](std::uint32_t y, std::span<T> row) {
    const std::size_t first = std::size_t{y} * row.size();
    if (first + row.size() > pixels.size()) throw std::logic_error("image: too few pixels");
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(first), row.size(), row.begin());
  };
}

}  // namespace sheaf
