// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <vector>

namespace sheaf {
namespace {

using Out = std::back_insert_iterator<std::string>;

template <typename... Args>
void line(Out& out, const char* name, fmt::format_string<Args...> text, Args&&... args) {
  fmt::format_to(out, "{:<12}", name);
  fmt::format_to(out, text, std::forward<Args>(args)...);
  fmt::format_to(out, "\n");
}

std::string show(const Vec3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z);
}

/// What a hit of the material does, strongest words first.
std::string behaviour(const Material& m) {
  if (m.unlit) return "unlit";
  std::vector<std::string> parts;
  if (m.mirror_weight > 0.0F) {
    parts.push_back(
        fmt::format("mirror {:g}{}", m.mirror_weight, m.mirror_tinted ? " tinted" : ""));
  }
  if (m.transmission > 0.0F) {
    parts.push_back(fmt::format("transmission {:g}, ior {:g}", m.transmission, m.ior));
  }
  if (m.diffuse_weight > 0.0F) parts.push_back(fmt::format("diffuse {:g}", m.diffuse_weight));
  if (m.emission != Vec3(0.0F)) parts.push_back(fmt::format("emission {}", show(m.emission)));
  return parts.empty() ? "black" : fmt::format("{}", fmt::join(parts, ", "));
}

void show_geometry(Out& out, const Scene& scene, const SceneCounts& counts) {
  line(out, "triangles", "{}", scene.triangles.size());
  line(out, "vertices", "{}", scene.positions.size());
  line(out, "meshes", "{}, placed {} times by {} nodes", counts.meshes, counts.instances,
       counts.nodes);
  line(out, "bounds", "{} to {}", show(scene.bounds.lo), show(scene.bounds.hi));
}

void show_materials(Out& out, const Scene& scene, const SceneCounts& counts) {
  std::vector<std::uint64_t> triangles(scene.materials.size(), 0);
  for (const std::uint16_t m : scene.triangle_material) ++triangles[m];
  line(out, "materials", "{} in use, {} in the file", scene.materials.size(), counts.materials);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    line(out, "", "{}: {}{}; {} triangles", m.name.empty() ? fmt::format("#{}", i) : m.name,
         behaviour(m), m.base_color_texture != kNoTexture ? ", textured" : "", triangles[i]);
  }
}

void show_textures(Out& out, const Scene& scene, const SceneCounts& counts) {
  std::uint64_t bytes = 0;
  for (const Texture& t : scene.textures) bytes += t.rgba.size();
  line(out, "textures", "{} in use, {} images in the file, {} KiB decoded", scene.textures.size(),
       counts.images, bytes / 1024);
  for (const Texture& t : scene.textures) line(out, "", "{} x {}", t.width, t.height);
}

std::string describe(const Light& light) {
  switch (light.type) {
    case Light::Type::kPoint:
      return fmt::format("point at {}, {} cd", show(light.position), show(light.intensity));
    case Light::Type::kSpot:
      return fmt::format("spot at {} along {}, {} cd", show(light.position), show(light.direction),
                         show(light.intensity));
    case Light::Type::kDirectional:
      return fmt::format("directional along {}, {} lx", show(light.direction),
                         show(light.intensity));
  }
  return {};
}

void show_lights(Out& out, const Scene& scene) {
  constexpr std::size_t kShown = 16;
  line(out, "lights", "{}", scene.lights.size());
  for (std::size_t i = 0; i < std::min(kShown, scene.lights.size()); ++i) {
    line(out, "", "{}", describe(scene.lights[i]));
  }
  if (scene.lights.size() > kShown) line(out, "", "and {} more", scene.lights.size() - kShown);
}

void show_cameras(Out& out, const Scene& scene, const SceneCounts& counts) {
  line(out, "cameras", "{}",
       counts.cameras.empty() ? "none" : fmt::format("{}", fmt::join(counts.cameras, ", ")));
  const Camera& c = scene.camera;
  const std::string lens =
      c.orthographic ? fmt::format("orthographic, {:g} high", 2.0F * c.half_height)
                     : fmt::format("yfov {:.4g} degrees",
                                   std::atan(double{c.half_height}) * 360.0 / std::numbers::pi);
  line(out, "camera", "{}: at {} along {}, {}", counts.camera, show(c.position), show(c.forward),
       lens);
}

void show_needs(Out& out, const SceneNeeds& needs) {
  const auto say = [&](const char* name, bool needed, const char* without) {
    line(out, "", "{}: {}", name, needed ? "yes" : without);
  };
  line(out, "needs", "");
  say("shadow path", needs.lights, "no; no light, or nothing diffuse to receive one");
  say("reflection", needs.reflection, "no; nothing reflects");
  say("refraction", needs.refraction, "no; nothing transmits");
  say("textures", needs.textures, "no; nothing is textured");
}

}  // namespace

std::string scene_info(const LoadedScene& loaded) {
  std::string text;
  Out out(text);
  show_geometry(out, loaded.scene, loaded.counts);
  show_materials(out, loaded.scene, loaded.counts);
  show_textures(out, loaded.scene, loaded.counts);
  show_lights(out, loaded.scene);
  show_cameras(out, loaded.scene, loaded.counts);
  if (!loaded.counts.extensions.empty()) {
    line(out, "extensions", "{}", fmt::join(loaded.counts.extensions, ", "));
  }
  show_needs(out, loaded.scene.needs);
  for (const std::string& warning : loaded.warnings) line(out, "warning", "{}", warning);
  return text;
}

}  // namespace sheaf
