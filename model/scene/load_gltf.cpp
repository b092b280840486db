// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/load_gltf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

#include "base/errors.h"
#include "base/huge_pages.h"
#include "base/out_of_memory.h"
#include "base/text.h"
#include "scene/camera_setup.h"
#include "scene/gltf_camera.h"
#include "scene/gltf_document.h"
#include "scene/gltf_light.h"
#include "scene/gltf_material.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_plan.h"
#include "scene/gltf_primitive.h"
#include "scene/scene_needs.h"

namespace sheaf {
namespace {

using namespace gltf;

Vec3 center(const Box& box) {
  return {(Vec3d(box.lo) + Vec3d(box.hi)) * 0.5};
}

/// Grown step by step, the arrays would need twice their memory for a while. Room for vertices that
/// turn out to be shared is never touched.
void reserve(Scene& scene, const GeometryPlan& plan) {
  reserve_on_huge_pages(scene.triangles, plan.triangles);
  reserve_on_huge_pages(scene.triangle_material, plan.triangles);
  reserve_on_huge_pages(scene.positions, plan.max_vertices);
  reserve_on_huge_pages(scene.normals, plan.max_vertices);
  if (!scene.textures.empty()) reserve_on_huge_pages(scene.uvs, plan.max_vertices);
}

void read_geometry(Document& document, const PlacedNodes& placed, const SceneLoadOptions& options,
                   LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  const GeometryPlan plan = plan_geometry(document, placed);
  loaded.counts.instances = plan.instances;
  MaterialReader materials(document, options.reflectance, scene);
  std::vector<std::uint16_t> material_of;
  for (const PlannedPrimitive& p : plan.primitives) {
    material_of.push_back(materials.use(p.place + "/material", p.primitive->material));
  }
  reserve(scene, plan);
  PrimitiveWriter writer(document, scene, !scene.textures.empty());
  for (std::size_t i = 0; i < plan.primitives.size(); ++i) {
    const PlannedPrimitive& p = plan.primitives[i];
    writer.write(p, plan.placements[static_cast<std::size_t>(p.mesh)], material_of[i],
                 materials.uv_source(material_of[i]));
  }
}

Camera named_camera(const std::vector<NamedCamera>& cameras, const std::string& name,
                    const std::string& file) {
  const auto by = [&](std::string NamedCamera::*member) {
    return std::find_if(cameras.begin(), cameras.end(),
                        [&](const NamedCamera& c) { return c.*member == name; });
  };
  auto found = by(&NamedCamera::name);
  if (found == cameras.end()) found = by(&NamedCamera::own_name);
  if (found != cameras.end()) return found->camera;
  std::vector<std::string> names;
  names.reserve(cameras.size());
  for (const NamedCamera& c : cameras) names.push_back("\"" + c.name + "\"");
  throw Error(ExitCode::kUsage,
              fmt::format("camera.name: {} has no camera \"{}\"; it has {}", file, printable(name),
                          names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// The scene's own camera, or one that frames the scene.
Camera own_camera(const std::vector<NamedCamera>& cameras, const SceneLoadOptions& options,
                  const Box& bounds, const std::string& file, std::string& origin) {
  if (!options.camera_name.empty()) {
    origin = options.camera_name;
    return named_camera(cameras, options.camera_name, file);
  }
  if (!cameras.empty()) {
    origin = cameras.front().name.empty() ? "the file's first" : cameras.front().name;
    return cameras.front().camera;
  }
  origin = "framed automatically";
  return frame_box(bounds);
}

void set_camera(const std::vector<NamedCamera>& cameras, const SceneLoadOptions& options,
                const std::string& file, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  Camera camera = own_camera(cameras, options, scene.bounds, file, loaded.counts.camera);
  if (options.camera_position || options.camera_look_at) {
    const Camera lens = camera;
    camera = look_at(options.camera_position.value_or(lens.position),
                     options.camera_look_at.value_or(center(scene.bounds)));
    // A position of its own has nothing to do with the file's camera, so only a turned one keeps
    // its lens.
    if (!options.camera_position) {
      camera.orthographic = lens.orthographic;
      camera.half_height = lens.half_height;
    }
    loaded.counts.camera = "configured";
  }
  if (options.camera_yfov) {
    camera.orthographic = false;
    camera.half_height =
        static_cast<float>(std::tan(double{*options.camera_yfov} * std::numbers::pi / 360.0));
  }
  scene.camera = camera;
}

Light configured_light(const SceneLoadOptions& options, const Box& bounds) {
  Light light;
  light.position = *options.light_position;
  if (options.light_intensity) {
    light.intensity = Vec3(*options.light_intensity);
    return light;
  }
  const Vec3d way = Vec3d(light.position) - Vec3d(center(bounds));
  double square = glm::dot(way, way);
  // A light in the very centre is taken to stand half the diagonal away.
  if (square == 0.0) {
    const Vec3d diagonal = Vec3d(bounds.hi) - Vec3d(bounds.lo);
    square = glm::dot(diagonal, diagonal) / 4;
  }
  const double most = std::numeric_limits<float>::max();
  light.intensity = Vec3(static_cast<float>(std::min(std::numbers::pi * square, most)));
  return light;
}

void set_lights(Document& document, const PlacedNodes& placed, const SceneLoadOptions& options,
                Scene& scene) {
  if (options.light_position) {
    scene.lights = {configured_light(options, scene.bounds)};
    return;
  }
  scene.lights = read_lights(document, placed);
  const bool glows =
      std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const Material& m) { return m.unlit || m.emission != Vec3(0.0F); });
  if (scene.lights.empty() && !glows && options.background == Vec3(0.0F)) {
    document.warnings.add(
        "the scene has no light and the picture will be black; set "
        "light.position");
  } else if (scene.lights.empty() && !glows) {
    document.warnings.add(
        "the scene has no light: only its background gives any; set "
        "light.position");
  }
}

SceneCounts count(const Document& document, const std::vector<NamedCamera>& cameras) {
  SceneCounts counts;
  counts.nodes = document.model.nodes.size();
  counts.meshes = document.model.meshes.size();
  counts.materials = document.model.materials.size();
  counts.images = document.images.size();
  for (const NamedCamera& c : cameras) counts.cameras.push_back(c.name);
  for (const std::string& e : document.model.extensionsUsed) {
    counts.extensions.push_back(printable(e, 80));
  }
  return counts;
}

LoadedScene load(const std::filesystem::path& path, const SceneLoadOptions& options) {
  LoadedScene loaded;
  Document document = open_document(path);
  const PlacedNodes placed = place_nodes(document);
  const std::vector<NamedCamera> cameras = read_cameras(document, placed);
  loaded.counts = count(document, cameras);
  loaded.scene.background = options.background;
  read_geometry(document, placed, options, loaded);
  set_camera(cameras, options, path.string(), loaded);
  set_lights(document, placed, options, loaded.scene);
  loaded.scene.needs = make_needs(loaded.scene);
  loaded.warnings = document.warnings.lines();
  return loaded;
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& path, const SceneLoadOptions& options) {
  const std::string file = path.string();
  try {
    return load(path, options);
  } catch (const Refusal& refusal) {
    throw Error(ExitCode::kScene,
                fmt::format("{}: {}", file, printable(refusal.what(), gltf::kLongestMessage)));
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::kScene, fmt::format("{}: {}", file, kOutOfMemory));
  }
}

}  // namespace sheaf
