// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_needs.h"

#include <vector>

namespace sheaf {

SceneNeeds make_needs(const Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint16_t material : scene.triangle_material) used[material] = true;
  SceneNeeds needs;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const Material& m = scene.materials[i];
    needs.lights = needs.lights || (!scene.lights.empty() && m.diffuse());
    needs.reflection = needs.reflection || m.reflects();
    needs.refraction = needs.refraction || m.refracts();
    needs.textures =
        needs.textures || m.base_color_texture != kNoTexture || m.emission_texture != kNoTexture;
  }
  return needs;
}

}  // namespace sheaf
