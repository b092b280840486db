// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Rays that start on surfaces: none meets the surface it starts from, none slips out behind it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shading/shader.h"
#include "stability/catalogue.h"
#include "stability/exact.h"
#include "stability/extreme_meshes.h"
#include "stability/mesh_scene.h"
#include "stability/shaded_mesh.h"
#include "stability/two_mirrors.h"

namespace sheaf::stability {
namespace {

const char* const kOffset =
    "origins leave by 256 ulps, by 2^-16 of the scene's unit near zero (Wachter and Binder 2019) "
    "and by 2^-20 of large triangles (decision 0060), more than positions and t are off";

Material everything() {
  Material material;
  material.diffuse_weight = 0.3F;
  material.mirror_weight = 0.3F;
  material.transmission = 0.4F;
  return material;
}

/// A mesh with a shader on it.
class ShadedMesh {
 public:
  explicit ShadedMesh(const Mesh& mesh)
      : mesh_(mesh), scene_(scene_of(mesh, everything())), shader_(scene_, {100, 0.0F}) {
    Light sun;
    sun.type = Light::Type::kDirectional;
    sun.direction = glm::normalize(Vec3(0.3F, -0.8F, 0.5F));
    scene_.lights = {sun};
  }

  [[nodiscard]] const MeshScene& mesh() const { return mesh_; }
  [[nodiscard]] const Shader& shader() const { return shader_; }

  /// Where a ray meets the mesh; triangle kNoHit if nowhere.
  [[nodiscard]] sheaf::Hit closest(const Ray& ray) const {
    RayPacket packet;
    packet.clear(1);
    packet.put(0, ray);
    TraceCounts counts;
    trace_packet(TraversalScheme::kSingle, mesh_.tree, mesh_.records, packet, nullptr, nullptr,
                 counts);
    return {packet.hit_t[0], packet.hit_u[0], packet.hit_v[0], packet.hit_triangle[0]};
  }

 private:
  MeshScene mesh_;
  Scene scene_;
  Shader shader_;
};

/// Counts the rays spawned at grazing hits that meet the triangle they start from, or another in
/// its plane.
std::vector<Finding> leave_surfaces(const Mesh& mesh, int num_rays) {
  const ShadedMesh shaded(mesh);
  const std::vector<TriangleRecord>& records = shaded.mesh().records;
  Failures own;
  Random random(61);
  for (int i = 0; i < num_rays; ++i) {
    const Ray ray = [&] {
      Ray made = grazing_ray(shaded.mesh(), random);
      made.weight = Vec3(1.0F);
      return made;
    }();
    const sheaf::Hit hit = shaded.closest(ray);
    if (hit.triangle == kNoHit) continue;
    const Surface surface = shaded.shader().surface(ray, hit);
    const auto check = [&](bool spawned, const Ray& child) {
      if (!spawned) return;
      const std::uint32_t met = shaded.closest(child).triangle;
      own.check(met == kNoHit || !are_coplanar(records[hit.triangle], records[met]),
                [&] { return describe(ray); });
    };
    Ray child;
    check(shaded.shader().reflect(ray, surface, child), child);
    check(shaded.shader().refract(ray, surface, child), child);
    check(shaded.shader().shadow(ray, surface, 0, child), child);
  }
  return {own.finding("rays that meet the plane of the triangle they start from", kOffset)};
}

/// Counts the rays that get out of a closed mesh within 100 reflections.
std::vector<Finding> stay_inside(const Mesh& mesh, int num_rays) {
  const ShadedMesh shaded(mesh);
  const Box& box = shaded.mesh().tree.bounds;
  const Vec3 centre = 0.5F * (box.lo + box.hi);
  Failures out;
  Random random(62);
  for (int i = 0; i < num_rays; ++i) {
    const Ray first = make_ray(centre, random_direction(random));
    Ray ray = first;
    ray.weight = Vec3(1.0F);
    bool inside = true;
    for (int bounce = 0; inside && bounce < 100; ++bounce) {
      const sheaf::Hit hit = shaded.closest(ray);
      inside = hit.triangle != kNoHit;
      Ray child;
      if (!inside || !shaded.shader().reflect(ray, shaded.shader().surface(ray, hit), child)) break;
      child.weight = Vec3(1.0F);
      ray = child;
    }
    out.check(inside, [&] { return describe(first); });
  }
  return {out.finding("rays that get out of a closed mesh within 100 reflections", kOffset)};
}

}  // namespace

std::vector<StabilityCase> secondary_cases() {
  constexpr int kRays = 100'000;
  constexpr int kPaths = 2'000;
  std::vector<StabilityCase> cases;
  for (const SurfaceMesh& source : surface_meshes()) {
    cases.push_back({"secondary", source.name, source.extreme, [source](const Effort& effort) {
                       std::vector<Finding> findings =
                           leave_surfaces(source.mesh, effort.trials(kRays));
                       if (source.closed) {
                         std::ranges::move(stay_inside(source.mesh, effort.trials(kPaths)),
                                           std::back_inserter(findings));
                       }
                       return findings;
                     }});
  }
  cases.push_back({"secondary", "two mirrors", "100 reflections at 0.999 between parallel mirrors",
                   [](const Effort&) { return two_mirrors(); }});
  return cases;
}

}  // namespace sheaf::stability
