// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "geometry/vec.h"

namespace sheaf {

/// sRGB encoding (IEC 61966-2-1) of a linear value in 8 bits; clamped to [0, 1], NaN counts as 0.
[[nodiscard]] std::uint8_t linear_to_srgb(float linear);

/// A PNG file of linear RGB pixels, row by row from the top, in 8-bit sRGB. The same input gives
/// the same bytes. Throws std::logic_error if there are not width × height pixels.
[[nodiscard]] std::vector<std::uint8_t> encode_png(std::uint32_t width, std::uint32_t height,
                                                   std::span<const Vec3> pixels);

/// A counter per pixel in false colours from dark (0) to light (the largest value of the image).
/// Values that are negative or not finite count as 0.
[[nodiscard]] std::vector<std::uint8_t> encode_heat_map_png(std::uint32_t width,
                                                            std::uint32_t height,
                                                            std::span<const float> values);

/// The same into a file. Throws Error(kOutput, "<path>: <reason>") if it cannot be written.
void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const Vec3> pixels);
void write_heat_map_png(const std::filesystem::path& path, std::uint32_t width,
                        std::uint32_t height, std::span<const float> values);

}  // namespace sheaf
