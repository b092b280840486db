// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/two_mirrors.h"

#include <fmt/format.h>

#include <cmath>

#include "stability/exact.h"
#include "stability/film_rounding.h"
#include "stability/mesh_scene.h"
#include "stability/shaded_mesh.h"

namespace sheaf::stability {
namespace {

constexpr int kDepth = 100;
constexpr float kReflectance = 0.999F;
const Vec3 kEmission(1.0F, 1e-30F, 1e30F);
/// 100 products of weights, one with the emission, one rounding of an exact sum.
constexpr double kOfWeights = gamma(kDepth + 2);

/// Two parallel mirrors one unit apart, the lower one glowing, seen slightly aslant from between.
Scene make_scene() {
  Mesh mesh;
  for (const float z : {0.0F, 1.0F}) {
    mesh.add_quad(Vec3(-50.0F, -50.0F, z), Vec3(100.0F, 0.0F, 0.0F), Vec3(0.0F, 100.0F, 0.0F));
  }
  Material mirror;
  mirror.diffuse_weight = 0.0F;
  mirror.mirror_weight = kReflectance;
  mirror.mirror_tinted = false;
  Scene scene = scene_of(mesh, mirror);
  scene.materials.push_back(mirror);
  scene.materials[0].emission = kEmission;
  scene.triangle_material = {0, 0, 1, 1};
  scene.camera.position = Vec3(-10.0F, -10.0F, 0.5F);
  scene.camera.forward = glm::normalize(Vec3(0.1F, 0.07F, -1.0F));
  scene.camera.right = glm::normalize(glm::cross(scene.camera.forward, Vec3(0.0F, 1.0F, 0.0F)));
  scene.camera.up = glm::cross(scene.camera.right, scene.camera.forward);
  scene.camera.half_height = 0.01F;
  return scene;
}

Picture render_in(const Scene& scene, const char* format) {
  return render(scene, {fmt::format("render.recursion_level={}", kDepth),
                        fmt::format("film.format={}", format)});
}

/// What a pixel gets: emission × reflectance^0, ^2, … ^100.
std::vector<double> series(double emission) {
  std::vector<double> terms;
  for (int bounce = 0; bounce <= kDepth; bounce += 2) {
    terms.push_back(emission * std::pow(double{kReflectance}, bounce));
  }
  return terms;
}

double sum_of(const std::vector<double>& terms) {
  double sum = 0.0;
  for (const double term : terms) sum += term;
  return sum;
}

Finding in_exact(const Picture& picture) {
  Largest error;
  for (int channel = 0; channel < 3; ++channel) {
    const double right = sum_of(series(double{kEmission[channel]}));
    for (const Vec3& pixel : picture.pixels) {
      error.add(std::abs(double{pixel[channel]} - right) / right, [] { return ""; });
    }
  }
  return error.finding("relative error of a pixel against the geometric series, in exact",
                       {kOfWeights,
                        "gamma(102): 100 products of weights, one with the emission, one rounding "
                        "of the exact sum"});
}

/// The contributions to a channel, rounded as the shader rounds them.
std::vector<float> contributions(float emission) {
  std::vector<float> terms;
  float weight = 1.0F;
  for (int bounce = 0; bounce <= kDepth; ++bounce) {
    if (bounce % 2 == 0) terms.push_back(weight * emission);
    weight *= kReflectance;
  }
  return terms;
}

/// A format that loses nearly everything has no useful bound against the series; what it must hold
/// follows from its definition.
Finding in_format(const FilmRounding& format, const Picture& picture) {
  Failures wrong;
  for (int channel = 0; channel < 3; ++channel) {
    const float right = sums_by_definition(format.format, contributions(kEmission[channel])).back();
    for (const Vec3& pixel : picture.pixels) {
      wrong.check(pixel[channel] == right,
                  [&] { return fmt::format("channel {}: {:a}", channel, pixel[channel]); });
    }
  }
  return wrong.finding(fmt::format("channels in {} unlike its definition's", format.name),
                       "51 contributions, each added and rounded in integers");
}

}  // namespace

std::vector<Finding> two_mirrors() {
  const Scene scene = make_scene();
  const Picture exact = render_in(scene, "exact");
  Failures rays;
  rays.check(exact.num_rays == exact.pixels.size() * (kDepth + 1),
             [&] { return fmt::format("{} rays", exact.num_rays); });
  std::vector<Finding> findings = {in_exact(exact),
                                   rays.finding("pictures with more or fewer than 101 rays a pixel",
                                                "each ray meets the other mirror")};
  for (const FilmRounding& format : kFilmRoundings) {
    findings.push_back(in_format(format, render_in(scene, format.name)));
  }
  return findings;
}

}  // namespace sheaf::stability
