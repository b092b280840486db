// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/film.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/paged_array.h"
#include "image/exact_sum.h"

namespace sheaf {
namespace {

constexpr float kFloatMax = std::numeric_limits<float>::max();

/// Rounding as Direct3D's float to UNORM conversion does it: scale, add a half, drop the fraction.
struct Unorm8Channel {
  static constexpr Bytes kBytesPerPixel = 4;
  std::uint8_t stored = 0;

  void add(float x) {
    const double sum = std::min(stored + 255.0 * static_cast<double>(x), 255.0);
    stored = static_cast<std::uint8_t>(sum + 0.5);
  }
  [[nodiscard]] float value() const { return static_cast<float>(stored) / 255.0F; }
};

/// The float next to the positive number x that lies towards zero, its last bit set if it is not x.
/// Rounding the result to fewer than 23 bits then equals rounding x itself ("round to odd";
/// Boldo and Melquiond, "Emulation of FMA and correctly rounded sums", IEEE ToC 57(4), 2008).
float round_to_odd(double x) {
  auto nearest = static_cast<float>(x);
  if (static_cast<double>(nearest) == x) {
    return nearest;
  }
  auto bits = std::bit_cast<std::uint32_t>(nearest);
  bits -= static_cast<double>(nearest) > x ? 1 : 0;
  return std::bit_cast<float>(bits | 1U);
}

struct HalfChannel {
  static constexpr Bytes kBytesPerPixel = 8;
  Imath::half stored{0.0F};

  void add(float x) {
    constexpr double kHalfMax = 65504.0;
    // The double sum is exact wherever the rounding to binary16 is not obvious: x is then at least
    // a 2^-13th of the stored value, and both have at most 24 bits.
    const double sum = static_cast<double>(float{stored}) + static_cast<double>(x);
    stored = Imath::half(round_to_odd(std::min(sum, kHalfMax)));
  }
  [[nodiscard]] float value() const { return stored; }
};

struct FloatChannel {
  static constexpr Bytes kBytesPerPixel = 16;
  float stored = 0.0F;

  void add(float x) { stored = std::min(stored + x, kFloatMax); }
  [[nodiscard]] float value() const { return stored; }
};

/// Three accumulators of 40 bytes.
struct ExactChannel : ExactSum {
  static constexpr Bytes kBytesPerPixel = 128;
};

[[noreturn]] void refuse(std::uint32_t pixel, const Vec3& c) {
  throw std::logic_error("film: contribution (" + std::to_string(c.x) + ", " + std::to_string(c.y) +
                         ", " + std::to_string(c.z) + ") to pixel " + std::to_string(pixel) +
                         " is not finite and non-negative");
}

/// False for NaN too.
bool valid(float x) {
  return x >= 0.0F && x <= kFloatMax;
}

template <typename Channel>
class FilmOf final : public Film {
 public:
  explicit FilmOf(std::uint32_t num_pixels) : pixels_(num_pixels) {}

  void add(std::uint32_t pixel, const Vec3& c) override {
    if (!(valid(c.x) && valid(c.y) && valid(c.z))) {
      refuse(pixel, c);
    }
    check_inside(pixel);
    auto& channels = pixels_[pixel];
    channels[0].add(c.x);
    channels[1].add(c.y);
    channels[2].add(c.z);
  }

  [[nodiscard]] Vec3 value(std::uint32_t pixel) const override {
    check_inside(pixel);
    const auto& channels = pixels_[pixel];
    return {channels[0].value(), channels[1].value(), channels[2].value()};
  }

  [[nodiscard]] Bytes bytes_per_pixel() const override { return Channel::kBytesPerPixel; }

 private:
  void check_inside(std::uint32_t pixel) const {
    if (pixel >= pixels_.size()) throw std::out_of_range("film: a pixel outside the film");
  }

  PagedArray<std::array<Channel, 3>> pixels_;  ///< zero bytes are 0 in every format
};

}  // namespace

std::unique_ptr<Film> make_film(FilmFormat format, std::uint32_t num_pixels) {
  switch (format) {
    case FilmFormat::kUnorm8:
      return std::make_unique<FilmOf<Unorm8Channel>>(num_pixels);
    case FilmFormat::kHalf:
      return std::make_unique<FilmOf<HalfChannel>>(num_pixels);
    case FilmFormat::kFloat:
      return std::make_unique<FilmOf<FloatChannel>>(num_pixels);
    case FilmFormat::kExact:
      return std::make_unique<FilmOf<ExactChannel>>(num_pixels);
  }
  throw std::logic_error("film: unknown format");
}

}  // namespace sheaf
