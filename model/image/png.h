// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "geometry/vec.h"
#include "image/rows.h"

namespace sheaf {

/// sRGB encoding (IEC 61966-2-1) of a linear value in 8 bits; clamped to [0, 1], NaN counts as 0.
[[nodiscard]] std::uint8_t linear_to_srgb(float linear);

/// Writes a PNG file of linear RGB pixels in 8-bit sRGB, row by row. The same input gives the same
/// bytes. Throws Error(kOutput, "<path>: <reason>") if it cannot be written, and std::logic_error
/// for an image without pixels.
void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               const RowSource<Vec3>& rows);

/// The same of a counter per pixel, in false colours from dark (0) to light (the largest value of
/// the image). Values that are negative or not finite count as 0. Reads the rows twice.
void write_heat_map_png(const std::filesystem::path& path, std::uint32_t width,
                        std::uint32_t height, const RowSource<float>& rows);

}  // namespace sheaf
