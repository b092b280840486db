// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <gtest/gtest.h>
#include <stb_image.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/errors.h"
#include "image/heat_color.h"
#include "rows_of.h"

namespace sheaf {
namespace {

struct Decoded {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> rgb;
};

Decoded decode(const std::vector<std::uint8_t>& png) {
  Decoded d;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(png.data(), static_cast<int>(png.size()), &d.width, &d.height,
                            &d.channels, 0),
      stbi_image_free);
  if (pixels) {
    d.rgb.assign(pixels.get(), pixels.get() + d.width * d.height * d.channels);
  }
  return d;
}

/// What is left in a file.
std::vector<std::uint8_t> written(const std::function<void(const std::filesystem::path&)>& write) {
  const auto path = std::filesystem::path(testing::TempDir()) / "sheaf_png_bytes.png";
  write(path);
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return bytes;
}

std::vector<std::uint8_t> encode_png(std::uint32_t width, std::uint32_t height,
                                     std::span<const Vec3> pixels) {
  return written([&](const auto& path) { write_png(path, width, height, rows_of(pixels)); });
}

std::vector<std::uint8_t> encode_heat_map_png(std::uint32_t width, std::uint32_t height,
                                              std::span<const float> values) {
  return written(
      [&](const auto& path) { write_heat_map_png(path, width, height, rows_of(values)); });
}

/// CIE luminance of an sRGB colour.
double luminance(const std::array<std::uint8_t, 3>& color) {
  constexpr std::array<double, 3> kShares{0.2126, 0.7152, 0.0722};
  double y = 0.0;
  for (std::size_t i = 0; i < color.size(); ++i) {
    y += kShares[i] * std::pow(color[i] / 255.0, 2.2);
  }
  return y;
}

TEST(Png, HasSignatureAndDimensions) {
  const std::vector<Vec3> pixels(5 * 3, Vec3(0.5F));
  const auto png = encode_png(5, 3, pixels);
  const std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  ASSERT_GT(png.size(), 24U);
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), png.begin()));
  EXPECT_EQ(png[19], 5);  // big-endian width and height of the header chunk
  EXPECT_EQ(png[23], 3);
}

TEST(Png, EncodesLinearColoursAsSrgb) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3> pixels{
      {0.0F, 1.0F, 0.5F}, {0.001F, 0.21586F, 2.0F}, {-1.0F, inf, nan}, {1.0F, 0.0F, 0.0F}};
  const Decoded d = decode(encode_png(2, 2, pixels));
  ASSERT_EQ(d.width, 2);
  ASSERT_EQ(d.height, 2);
  ASSERT_EQ(d.channels, 3);
  // 0.5 is 188 and 0.21586 is 128 in sRGB; 0.001 lies on the straight part.
  const std::vector<std::uint8_t> expected{0, 255, 188, 3, 128, 255, 0, 255, 0, 255, 0, 0};
  EXPECT_EQ(d.rgb, expected);
}

TEST(Png, HasTheSameBytesEveryTime) {
  const std::vector<Vec3> pixels(64 * 64, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(encode_png(64, 64, pixels), encode_png(64, 64, pixels));
}

TEST(Png, RefusesPixelsThatDoNotFit) {
  const std::vector<Vec3> pixels(3);
  EXPECT_THROW(encode_png(2, 2, pixels), std::logic_error);
  EXPECT_THROW(encode_png(0, 0, {}), std::logic_error);
}

TEST(Png, SaysWhichFileCannotBeWritten) {
  const std::vector<Vec3> pixels(1);
  try {
    write_png("/no_such_folder/image.png", 1, 1, rows_of<Vec3>(pixels));
    FAIL() << "written into a folder that does not exist";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_EQ(std::string(error.what()).rfind("/no_such_folder/image.png: ", 0), 0U);
  }
}

TEST(HeatMap, GrowsLighterWithEveryStep) {
  double last = -1.0;
  for (int i = 0; i <= 200; ++i) {
    const double y = luminance(heat_color(static_cast<float>(i) / 200.0F));
    EXPECT_GT(y, last) << "step " << i;
    last = y;
  }
}

TEST(HeatMap, StretchesFromZeroToTheLargestValue) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> values{0.0F, 500.0F, 1000.0F, -5.0F, inf, 250.0F};
  const Decoded d = decode(encode_heat_map_png(3, 2, values));
  const auto pixel = [&](std::size_t i) {
    return std::array<std::uint8_t, 3>{d.rgb.at(3 * i), d.rgb.at(3 * i + 1), d.rgb.at(3 * i + 2)};
  };
  EXPECT_EQ(pixel(0), heat_color(0.0F));
  EXPECT_EQ(pixel(1), heat_color(0.5F));
  EXPECT_EQ(pixel(2), heat_color(1.0F));
  EXPECT_EQ(pixel(3), heat_color(0.0F));
  EXPECT_EQ(pixel(4), heat_color(0.0F));
  EXPECT_EQ(pixel(5), heat_color(0.25F));
}

TEST(HeatMap, IsDarkWhereNothingWasCounted) {
  const std::vector<float> values(4, 0.0F);
  const Decoded d = decode(encode_heat_map_png(2, 2, values));
  const auto dark = heat_color(0.0F);
  EXPECT_EQ(d.rgb.at(0), dark[0]);
  EXPECT_EQ(d.rgb.at(11), dark[2]);
}

}  // namespace
}  // namespace sheaf
