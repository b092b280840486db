// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "image/file_output.h"
#include "image/heat_color.h"

namespace sheaf {
namespace {

constexpr int kChannels = 3;

void check_size(std::uint32_t width, std::uint32_t height, std::size_t num_pixels) {
  if (num_pixels == 0 || num_pixels != std::size_t{width} * height) {
    throw std::logic_error("png: the number of pixels is not width × height");
  }
}

void append(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

std::vector<std::uint8_t> encode_rgb8(std::uint32_t width, std::uint32_t height,
                                      const std::vector<std::uint8_t>& rgb) {
  std::vector<std::uint8_t> bytes;
  const int stride = static_cast<int>(width) * kChannels;
  if (stbi_write_png_to_func(append, &bytes, static_cast<int>(width), static_cast<int>(height),
                             kChannels, rgb.data(), stride) == 0) {
    throw std::runtime_error("png: the encoder failed");
  }
  return bytes;
}

float counted(float value) {
  return std::isfinite(value) && value > 0.0F ? value : 0.0F;
}

}  // namespace

std::uint8_t linear_to_srgb(float linear) {
  const float x = linear > 0.0F ? std::min(linear, 1.0F) : 0.0F;
  const float encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(encoded * 255.0F + 0.5F);
}

std::vector<std::uint8_t> encode_png(std::uint32_t width, std::uint32_t height,
                                     std::span<const Vec3> pixels) {
  check_size(width, height, pixels.size());
  std::vector<std::uint8_t> rgb;
  rgb.reserve(pixels.size() * kChannels);
  for (const Vec3& pixel : pixels) {
    rgb.insert(rgb.end(),
               {linear_to_srgb(pixel.x), linear_to_srgb(pixel.y), linear_to_srgb(pixel.z)});
  }
  return encode_rgb8(width, height, rgb);
}

std::vector<std::uint8_t> encode_heat_map_png(std::uint32_t width, std::uint32_t height,
                                              std::span<const float> values) {
  check_size(width, height, values.size());
  float largest = 0.0F;
  for (const float value : values) {
    largest = std::max(largest, counted(value));
  }
  std::vector<std::uint8_t> rgb;
  rgb.reserve(values.size() * kChannels);
  for (const float value : values) {
    const auto color = heat_color(largest > 0.0F ? counted(value) / largest : 0.0F);
    rgb.insert(rgb.end(), color.begin(), color.end());
  }
  return encode_rgb8(width, height, rgb);
}

void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const Vec3> pixels) {
  write_file(path, encode_png(width, height, pixels));
}

void write_heat_map_png(const std::filesystem::path& path, std::uint32_t width,
                        std::uint32_t height, std::span<const float> values) {
  write_file(path, encode_heat_map_png(width, height, values));
}

}  // namespace sheaf
