// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/file_output.h"
#include "image/heat_color.h"

namespace sheaf {
namespace {

constexpr std::size_t kChannels = 3;

/// libpng's writer of 8-bit RGB rows.
class PngOutput {
 public:
  PngOutput(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height)
      : file_(path), row_(width * kChannels) {
    png_set_write_fn(
        png_, &file_,
        [](png_structp png, png_bytep bytes, std::size_t size) {
          static_cast<FileOutput*>(png_get_io_ptr(png))->write({bytes, size});
        },
        [](png_structp) {});
    png_set_IHDR(png_, info_, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
  }
  ~PngOutput() { png_destroy_write_struct(&png_, &info_); }
  PngOutput(const PngOutput&) = delete;
  PngOutput& operator=(const PngOutput&) = delete;

  /// To be filled for the next write_row().
  [[nodiscard]] std::uint8_t* pixel(std::size_t x) { return row_.data() + x * kChannels; }
  void write_row() { png_write_row(png_, row_.data()); }
  void close() {
    png_write_end(png_, info_);
    file_.close();
  }

 private:
  // Exceptions pass through libpng, which holds nothing that needs unwinding.
  [[noreturn]] static void refuse(png_structp /*png*/, png_const_charp message) {
    throw std::logic_error(std::string("png: ") + message);
  }
  static void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

  FileOutput file_;
  png_structp png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse, ignore);
  png_infop info_ = png_create_info_struct(png_);
  std::vector<std::uint8_t> row_;
};

void check_size(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0) throw std::logic_error("png: an image without pixels");
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

void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               const RowSource<Vec3>& rows) {
  check_size(width, height);
  PngOutput png(path, width, height);
  std::vector<Vec3> row(width);
  for (std::uint32_t y = 0; y < height; ++y) {
    rows(y, row);
    for (std::size_t x = 0; x < width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        png.pixel(x)[channel] = linear_to_srgb(row[x][channel]);
      }
    }
    png.write_row();
  }
  png.close();
}

void write_heat_map_png(const std::filesystem::path& path, std::uint32_t width,
                        std::uint32_t height, const RowSource<float>& rows) {
  check_size(width, height);
  std::vector<float> row(width);
  float largest = 0.0F;
  for (std::uint32_t y = 0; y < height; ++y) {
    rows(y, row);
    for (const float value : row) largest = std::max(largest, counted(value));
  }
  PngOutput png(path, width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    rows(y, row);
    for (std::size_t x = 0; x < width; ++x) {
      const auto color = heat_color(largest > 0.0F ? counted(row[x]) / largest : 0.0F);
      std::copy(color.begin(), color.end(), png.pixel(x));
    }
    png.write_row();
  }
  png.close();
}

}  // namespace sheaf
