// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "shading/texel_accesses.h"

#include "shading/texture_lookup.h"

namespace sheaf {

void add_texel_accesses(const Scene& scene, const Hit& hit, std::vector<TexelAccess>& texels) {
  const Material& material = scene.materials[scene.triangle_material[hit.triangle]];
  for (const std::int32_t texture : {material.base_color_texture, material.emission_texture}) {
    if (texture == kNoTexture) continue;
    const auto& [a, b, c] = scene.triangles[hit.triangle];
    const float w = 1.0F - hit.u - hit.v;
    const Vec2 uv = w * scene.uvs[a] + hit.u * scene.uvs[b] + hit.v * scene.uvs[c];
    const auto index = static_cast<std::uint32_t>(texture);
    const TextureSample sample = sample_texture(scene.textures[index], uv);
    for (int i = 0; i < sample.num_texels; ++i) {
      texels.push_back({index, sample.texels[i].x, sample.texels[i].y});
    }
  }
}

}  // namespace sheaf
