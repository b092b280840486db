// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace sheaf {

/// Fills row `y` of an image, counted from the top; the row's length is the image's width. Images
/// are written row by row, so that no second copy of them need exist.
template <typename T>
using RowSource = std::function<void(std::uint32_t y, std::span<T> row)>;

}  // namespace sheaf
