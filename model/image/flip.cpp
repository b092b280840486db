// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace sheaf {
namespace {

constexpr double kPi = std::numbers::pi;

// Colour spaces. The rows of the matrix are those of linear sRGB to CIE XYZ; white is (1, 1, 1).
constexpr std::array<Vec3d, 3> kToXyz{
    Vec3d{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    Vec3d{2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    Vec3d{1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};
constexpr std::array<Vec3d, 3> kFromXyz{
    Vec3d{3.241003232976358, -1.537398969488785, -0.498615881996363},
    Vec3d{-0.969224252202516, 1.875929983695176, 0.041554226340085},
    Vec3d{0.055639419851975, -0.204011206123910, 1.057148977187533}};

Vec3d times(const std::array<Vec3d, 3>& rows, const Vec3d& v) {
  return {glm::dot(rows[0], v), glm::dot(rows[1], v), glm::dot(rows[2], v)};
}

// Relative to white.
Vec3d to_xyz(const Vec3d& rgb) {
  return times(kToXyz, rgb) / times(kToXyz, Vec3d(1.0));
}

Vec3d to_opponent(const Vec3d& rgb) {
  const Vec3d p = to_xyz(rgb);
  return {116.0 * p.y - 16.0, 500.0 * (p.x - p.y), 200.0 * (p.y - p.z)};
}

Vec3d from_opponent(const Vec3d& ycc) {
  const double y = (ycc.x + 16.0) / 116.0;
  const Vec3d p{y + ycc.y / 500.0, y, y - ycc.z / 200.0};
  return times(kFromXyz, p * times(kToXyz, Vec3d(1.0)));
}

double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  if (t > kDelta * kDelta * kDelta) return std::cbrt(t);
  return t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

// CIELAB with Hunt's effect: colours of dark places differ less.
Vec3d to_hunt_lab(const Vec3d& rgb) {
  const Vec3d p = to_xyz(rgb);
  const Vec3d f{lab_curve(p.x), lab_curve(p.y), lab_curve(p.z)};
  const double lightness = 116.0 * f.y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f.x - f.y),
          0.01 * lightness * 200.0 * (f.y - f.z)};
}

double hyab(const Vec3d& a, const Vec3d& b) {
  return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// One channel of a picture, or one filter's answer.
class Plane {
 public:
  Plane(std::uint32_t width, std::uint32_t height)
      : width_(static_cast<int>(width)),
        height_(static_cast<int>(height)),
        values_(std::size_t{width} * height) {}
  double& operator[](std::size_t i) { return values_[i]; }
  double operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }

  /// Convolves along rows with `across`, then along columns with `down`; both have odd length, and
  /// the border goes on outside the picture.
  [[nodiscard]] Plane filtered(const std::vector<double>& across,
                               const std::vector<double>& down) const {
    return convolved(across, 1, 0).convolved(down, 0, 1);
  }

 private:
  [[nodiscard]] Plane convolved(const std::vector<double>& kernel, int dx, int dy) const {
    Plane result = *this;
    const int radius = static_cast<int>(kernel.size() / 2);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        double sum = 0;
        for (int i = 0; i <= 2 * radius; ++i) {
          const int at_x = std::clamp(x + (i - radius) * dx, 0, width_ - 1);
          const int at_y = std::clamp(y + (i - radius) * dy, 0, height_ - 1);
          sum += kernel[static_cast<std::size_t>(i)] * values_[index(at_x, at_y)];
        }
        result.values_[index(x, y)] = sum;
      }
    }
    return result;
  }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<double> values_;
};

template <typename F>
std::vector<double> kernel_of(int radius, const F& f) {
  std::vector<double> kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(f(static_cast<double>(i)));
  return kernel;
}

double sum_of(const std::vector<double>& kernel) {
  double sum = 0;
  for (const double k : kernel) sum += k;
  return sum;
}

/// Contrast sensitivity of one opponent channel: a sum of two Gaussians of the plane, amplitudes a
/// and spreads b in squared degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities{
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidestSpread = 0.04;

// What the eye makes of one channel at this distance.
Plane seen(const Plane& channel, const Sensitivity& eye, double pixels_per_degree) {
  const int radius = static_cast<int>(
      std::ceil(3.0 * std::sqrt(kWidestSpread / (2.0 * kPi * kPi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return kernel_of(radius, [&](double x) {
      const double degrees = x / pixels_per_degree;
      return std::exp(-kPi * kPi * degrees * degrees / b);
    });
  };
  const std::vector<double> g1 = gaussian(eye.b1);
  const std::vector<double> g2 = gaussian(eye.b2);
  const double weight1 = eye.a1 * std::sqrt(kPi / eye.b1);
  const double weight2 = eye.a2 * std::sqrt(kPi / eye.b2);
  const double total = weight1 * sum_of(g1) * sum_of(g1) + weight2 * sum_of(g2) * sum_of(g2);
  Plane result = channel.filtered(g1, g1);
  if (weight2 == 0) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i] *= weight1 / total;
    return result;
  }
  const Plane second = channel.filtered(g2, g2);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = (weight1 * result[i] + weight2 * second[i]) / total;
  }
  return result;
}

/// Makes the positive weights sum to 1 and the negative ones to -1.
void balance(std::vector<double>& kernel) {
  double positive = 0;
  double negative = 0;
  for (const double k : kernel) (k > 0 ? positive : negative) += k;
  for (double& k : kernel) k /= k > 0 ? positive : -negative;
}

/// Strengths of edges and of points in the achromatic channel.
struct Features {
  Plane edges;
  Plane points;
};

Features features_of(const Plane& lightness, double pixels_per_degree) {
  constexpr double kFeatureWidth = 0.082;  // degrees
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto bell = [&](double x) { return std::exp(-x * x / (2.0 * deviation * deviation)); };
  std::vector<double> smooth = kernel_of(radius, bell);
  for (double& k : smooth) k /= sum_of(kernel_of(radius, bell));
  std::vector<double> first = kernel_of(radius, [&](double x) { return -x * bell(x); });
  std::vector<double> second = kernel_of(
      radius, [&](double x) { return (x * x / (deviation * deviation) - 1.0) * bell(x); });
  balance(first);
  balance(second);
  const auto strength = [&](const std::vector<double>& kernel) {
    Plane across = lightness.filtered(kernel, smooth);
    const Plane down = lightness.filtered(smooth, kernel);
    for (std::size_t i = 0; i < across.size(); ++i) across[i] = std::hypot(across[i], down[i]);
    return across;
  };
  return {strength(first), strength(second)};
}

/// A picture as both pipelines need it.
struct Seen {
  std::vector<Vec3d> lab;  ///< after the eye's filters
  Features features;
};

Seen look_at(std::span<const Vec3> image, std::uint32_t width, std::uint32_t height,
             double pixels_per_degree) {
  std::array<Plane, 3> channels{Plane(width, height), Plane(width, height), Plane(width, height)};
  Plane lightness(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3d ycc = to_opponent(glm::clamp(Vec3d(image[i]), 0.0, 1.0));
    for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)][i] = ycc[c];
    lightness[i] = (ycc.x + 16.0) / 116.0;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    channels[c] = seen(channels[c], kSensitivities[c], pixels_per_degree);
  }
  Seen result{{}, features_of(lightness, pixels_per_degree)};
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Vec3d ycc{channels[0][i], channels[1][i], channels[2][i]};
    result.lab.push_back(to_hunt_lab(glm::clamp(from_opponent(ycc), 0.0, 1.0)));
  }
  return result;
}

// Colour differences, compressed and spread over [0, 1], so that most of the range is left for
// small ones.
double color_difference(const Vec3d& a, const Vec3d& b) {
  constexpr double kExponent = 0.7;
  constexpr double kKnee = 0.4;     // share of the largest difference …
  constexpr double kAtKnee = 0.95;  // … that is mapped to this
  static const double kLargest =
      std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), kExponent);
  const double compressed = std::pow(hyab(a, b), kExponent);
  const double knee = kKnee * kLargest;
  if (compressed < knee) return kAtKnee / knee * compressed;
  return kAtKnee + (compressed - knee) / (kLargest - knee) * (1.0 - kAtKnee);
}

}  // namespace

double ldr_flip(std::span<const Vec3> image, std::span<const Vec3> reference, std::uint32_t width,
                std::uint32_t height, double pixels_per_degree) {
  const std::size_t pixels = std::size_t{width} * height;
  if (pixels == 0 || image.size() != pixels || reference.size() != pixels) {
    throw std::logic_error("ldr_flip: the pictures are empty or not of the size given");
  }
  const Seen a = look_at(image, width, height, pixels_per_degree);
  const Seen b = look_at(reference, width, height, pixels_per_degree);
  double sum = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double edges = std::fabs(a.features.edges[i] - b.features.edges[i]);
    const double points = std::fabs(a.features.points[i] - b.features.points[i]);
    const double feature = std::sqrt(std::max(edges, points) / std::numbers::sqrt2);
    sum += std::pow(color_difference(a.lab[i], b.lab[i]), 1.0 - feature);
  }
  return sum / static_cast<double>(pixels);
}

}  // namespace sheaf
