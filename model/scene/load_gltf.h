// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace sheaf {

/// What a run may say about a scene besides the file; parameters scene.*, camera.* and light.*.
/// Every member has an initializer, so that callers may name only those they set.
struct SceneLoadOptions {
  /// Every material gets this mirror weight r, untinted, in [0, 1], in place of its own mirror
  /// part; the rest is scaled to 1 - r: transmission t becomes (1 - r) t, diffuse (1 - r)(1 - t),
  /// and an unlit material becomes a light source of (1 - r) times its colour.
  std::optional<float> reflectance{};
  Vec3 background{0.0F};                  ///< radiance of a ray that leaves the scene
  std::string camera_name{};              ///< name of a camera or of its node; empty: the first
  std::optional<Vec3> camera_position{};  ///< world units; looks at camera_look_at or the centre
  std::optional<Vec3> camera_look_at{};   ///< world units
  std::optional<float> camera_yfov{};     ///< degrees, in (0, 180)
  std::optional<Vec3> light_position{};   ///< one white point light here instead of all others
  /// Candela of that light; none: its irradiance at the scene's centre is pi.
  std::optional<float> light_intensity{};
};

/// What the file held before it was flattened.
struct SceneCounts {
  std::uint64_t nodes = 0;              ///< in the file
  std::uint64_t meshes = 0;             ///< in the file
  std::uint64_t instances = 0;          ///< placements of meshes in the scene
  std::uint64_t materials = 0;          ///< in the file; Scene::materials has those in use
  std::uint64_t images = 0;             ///< in the file; Scene::textures has those in use
  std::vector<std::string> cameras;     ///< names of the cameras placed in the scene, in order
  std::vector<std::string> extensions;  ///< extensionsUsed
  std::string camera;                   ///< where Scene::camera comes from
};

struct LoadedScene {
  Scene scene;
  SceneCounts counts;
  std::vector<std::string> warnings;  ///< one line each: what of the file is not shown as meant
};

/// Reads a glTF 2.0 file (.gltf or .glb, told apart by content) and flattens its default scene
/// into world space: one pass over nodes, meshes and instances, metres and y up as in the file.
///
/// Positions are transformed in double precision and rounded once. Vertices that no triangle uses
/// are dropped; missing normals are made flat, which needs three vertices a triangle. Mirrored
/// instances keep counter-clockwise fronts. Only materials and textures in use are kept.
///
/// Materials: a metal (metallicFactor m) of roughnessFactor at most 0.1 is a mirror: mirror_weight
/// = m, tinted; rougher surfaces are diffuse, metal or not, because nothing here scatters glossily.
/// With t = transmissionFactor: transmission = t (1 - m), and diffuse_weight takes what is left, so
/// that the three weights add up to 1; refraction is always clear, whatever the roughness. Alpha
/// masks and blending are shown opaque, triangles are two-sided, and vertex colours, normal maps,
/// occlusion maps, skins, morph targets and animations are left out (a warning says which of those
/// a file has).
///
/// Extensions: KHR_lights_punctual, KHR_materials_emissive_strength, KHR_materials_ior,
/// KHR_materials_transmission, KHR_materials_unlit, KHR_mesh_quantization, KHR_texture_transform,
/// EXT_mesh_gpu_instancing. A file that requires any other is refused.
///
/// Throws Error(ExitCode::kScene) with one line "file: place: what is wrong; remedy" for anything
/// that is not such a file or that asks for more than the limits in gltf_limits.h, and
/// Error(ExitCode::kUsage) for a camera name that the file does not have.
[[nodiscard]] LoadedScene load_scene(const std::filesystem::path& path,
                                     const SceneLoadOptions& options = {});

}  // namespace sheaf
