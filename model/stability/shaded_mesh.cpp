// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/shaded_mesh.h"

#include "config/read_config.h"
#include "scene/camera_setup.h"
#include "scene/normals.h"
#include "scene/scene_needs.h"
#include "system/functional_pipeline.h"

namespace sheaf::stability {

Scene scene_of(const Mesh& mesh, const Material& material) {
  Scene scene;
  scene.materials = {material};
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const std::uint32_t corner : t) {
      scene.positions.push_back(mesh.positions[corner]);
      scene.bounds.add(mesh.positions[corner]);
    }
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.triangle_material.push_back(0);
  }
  scene.normals.assign(scene.positions.size(), Vec3(0.0F));
  fill_missing_normals(scene, 0, 0);
  scene.camera = frame_box(scene.bounds);
  return scene;
}

Picture render(const Scene& scene, const std::vector<std::string>& settings) {
  std::vector<std::string> all = {"run.fidelity=functional", "film.format=exact", "image.width=16",
                                  "image.height=16"};
  all.insert(all.end(), settings.begin(), settings.end());
  const Config config = resolve_config({}, all);
  Scene copy = scene;
  copy.needs = make_needs(copy);
  const PreparedScene prepared(std::move(copy), config);
  const BuildPlan plan = plan_machine(config, prepared.scene.needs);
  Frame frame(config);
  FunctionalPipeline pipeline(config, plan, prepared, frame);
  pipeline.run({});
  Picture picture;
  for (std::uint32_t i = 0; i < config.image.width * config.image.height; ++i) {
    picture.pixels.push_back(frame.film->value(i));
  }
  picture.num_rays = frame.rays.total().spawned;
  return picture;
}

}  // namespace sheaf::stability
