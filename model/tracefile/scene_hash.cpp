// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/scene_hash.h"

#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <type_traits>

namespace sheaf {
namespace {

/// Hashes values as they stand in memory, each without padding; arrays with their length in front.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

  template <typename T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    XXH3_128bits_update(state_.get(), &value, sizeof value);
  }
  template <typename T>
  void add_all(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::uint64_t{values.size()});
    XXH3_128bits_update(state_.get(), values.data(), values.size() * sizeof(T));
  }
  [[nodiscard]] Hash128 digest() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    Hash128 hash{};
    std::copy_n(canonical.digest, hash.size(), hash.begin());
    return hash;
  }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

void add_material(const Material& m, Hasher& hasher) {
  hasher.add(m.base_color);
  hasher.add(m.base_color_texture);
  hasher.add(m.emission);
  hasher.add(m.emission_texture);
  hasher.add(m.diffuse_weight);
  hasher.add(m.mirror_weight);
  hasher.add(m.mirror_tinted);
  hasher.add(m.transmission);
  hasher.add(m.ior);
  hasher.add(m.unlit);
}

void add_texture(const Texture& t, Hasher& hasher) {
  hasher.add(t.width);
  hasher.add(t.height);
  hasher.add(t.wrap_u);
  hasher.add(t.wrap_v);
  hasher.add(t.nearest);
  hasher.add_all(t.rgba);
}

void add_light(const Light& l, Hasher& hasher) {
  hasher.add(l.type);
  hasher.add(l.position);
  hasher.add(l.direction);
  hasher.add(l.intensity);
  hasher.add(l.range);
  hasher.add(l.cos_inner_cone);
  hasher.add(l.cos_outer_cone);
}

void add_camera(const Camera& c, Hasher& hasher) {
  hasher.add(c.position);
  hasher.add(c.right);
  hasher.add(c.up);
  hasher.add(c.forward);
  hasher.add(c.orthographic);
  hasher.add(c.half_height);
}

}  // namespace

Hash128 scene_hash(const Scene& scene) {
  Hasher hasher;
  hasher.add_all(scene.positions);
  hasher.add_all(scene.normals);
  hasher.add_all(scene.uvs);
  hasher.add_all(scene.triangles);
  hasher.add_all(scene.triangle_material);
  for (const Material& material : scene.materials) add_material(material, hasher);
  for (const Texture& texture : scene.textures) add_texture(texture, hasher);
  for (const Light& light : scene.lights) add_light(light, hasher);
  add_camera(scene.camera, hasher);
  hasher.add(scene.background);
  return hasher.digest();
}

}  // namespace sheaf
