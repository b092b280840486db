// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/machine_run.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <sstream>

#include "config/read_config.h"
#include "scene/scene_needs.h"
#include "stability/child_process.h"
#include "stability/shaded_mesh.h"
#include "system/clocked_machine.h"
#include "system/functional_pipeline.h"
#include "system/machine.h"

namespace sheaf::stability {
namespace {

/// After which a machine hangs: the second also where it waits, or others keep it waiting.
constexpr ChildLimits kLimits{.cpu_seconds = 60, .wall_seconds = 1200};

Texture checks() {
  Texture texture;
  texture.width = 16;
  texture.height = 16;
  for (std::uint32_t i = 0; i < texture.width * texture.height; ++i) {
    const auto grey = static_cast<std::uint8_t>((i + i / texture.width) % 2 == 0 ? 255 : 60);
    texture.rgba.insert(texture.rgba.end(), {grey, grey, grey, 255});
  }
  return texture;
}

/// The walls of the box, which are the triangles behind those of the ball, get a material of their
/// own, so that there are two materials and two sets of textures to be sorted by.
void make_walls(Scene& scene, std::size_t first_triangle) {
  Material walls;
  walls.diffuse_weight = 0.5F;
  walls.mirror_weight = 0.5F;
  scene.materials.push_back(walls);
  std::fill(scene.triangle_material.begin() + static_cast<std::ptrdiff_t>(first_triangle),
            scene.triangle_material.end(), std::uint16_t{1});
}

/// A glassy, shiny, checked ball in an open box of mirrors.
Scene make_scene() {
  Material glass;
  glass.diffuse_weight = 0.3F;
  glass.mirror_weight = 0.2F;
  glass.transmission = 0.5F;
  glass.base_color_texture = 0;
  Mesh mesh = bumpy_sphere(6, 8, 0.1F);
  const std::size_t ball = mesh.triangles.size();
  mesh.add_quad(Vec3(-3.0F, -1.2F, -3.0F), Vec3(0.0F, 0.0F, 6.0F), Vec3(6.0F, 0.0F, 0.0F));
  mesh.add_quad(Vec3(-3.0F, -1.2F, -3.0F), Vec3(6.0F, 0.0F, 0.0F), Vec3(0.0F, 4.0F, 0.0F));
  Scene scene = scene_of(mesh, glass);
  make_walls(scene, ball);
  scene.textures = {checks()};
  for (const Vec3& p : scene.positions) scene.uvs.emplace_back(p.x, p.y);
  Light light;
  light.position = Vec3(2.0F, 4.0F, 3.0F);
  light.intensity = Vec3(50.0F);
  scene.lights = {light};
  scene.background = Vec3(0.3F, 0.4F, 0.5F);
  return scene;
}

Scene with_needs(Scene scene) {
  scene.needs = make_needs(scene);
  return scene;
}

std::uint64_t hash_picture(const Frame& frame, const Config& config) {
  std::vector<Vec3> pixels;
  for (std::uint32_t i = 0; i < config.image.width * config.image.height; ++i) {
    pixels.push_back(frame.film->value(i));
  }
  return XXH3_64bits(pixels.data(), pixels.size() * sizeof(Vec3));
}

std::uint64_t hash_rays(const RayCounts& rays) {
  std::vector<std::uint64_t> counts;
  for (const auto& depth : rays.by_depth()) {
    for (const RayCounts::Entry& entry : depth) {
      counts.insert(counts.end(), {entry.spawned, entry.retired, entry.hits});
    }
  }
  return XXH3_64bits(counts.data(), counts.size() * sizeof(std::uint64_t));
}

template <typename Simulator>
bool simulate(const Config& config, const PreparedScene& scene, Frame& frame, StatsTree& stats) {
  const BuildPlan plan = plan_machine(config, scene.scene.needs);
  Simulator simulator(config, plan, scene, frame);
  const bool complete = simulator.run({});
  simulator.report(stats);
  return complete;
}

std::string failed(ExitCode code, const std::string& what) {
  return fmt::format("failed {} {}", static_cast<int>(code), what);
}

/// "done", then the numbers; or "failed", the exit code and what went wrong.
std::string run_here(const Config& config, const PreparedScene& scene) {
  try {
    Frame frame(config);
    StatsTree stats;
    const bool timed = config.run.fidelity != Fidelity::kFunctional;
    const bool complete = [&] {
      switch (config.run.fidelity) {
        case Fidelity::kFunctional:
          return simulate<FunctionalPipeline>(config, scene, frame, stats);
        case Fidelity::kClocked:
          return simulate<ClockedMachine>(config, scene, frame, stats);
        default:
          return simulate<Machine>(config, scene, frame, stats);
      }
    }();
    if (!complete) return failed(ExitCode::kBug, "the frame is not complete");
    return fmt::format("done {} {} {}", timed ? stats.count("system.cycles") : 0,
                       hash_picture(frame, config), hash_rays(frame.rays));
  } catch (const Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::exception& error) {
    return failed(ExitCode::kBug, error.what());
  }
}

MachineRun run_of(const std::string& answer) {
  std::istringstream words(answer);
  std::string first;
  int code = 0;
  MachineRun run;
  if (words >> first; first == "done") {
    words >> run.cycles >> run.picture >> run.rays;
  } else if (first == "failed" && words >> code) {
    run.code = static_cast<ExitCode>(code);
    std::getline(words >> std::ws, run.error);
  } else {
    run.code = ExitCode::kBug;
    run.error = answer.empty() ? "said nothing" : answer;
  }
  return run;
}

}  // namespace

MachineScene::MachineScene(std::uint32_t recursion_level)
    : MachineScene(make_scene(), recursion_level) {}

MachineScene::MachineScene(Scene scene, std::uint32_t recursion_level)
    : recursion_level_(recursion_level),
      scene_(with_needs(std::move(scene)), resolve_config({}, all({}))) {}

std::vector<std::string> MachineScene::all(const std::vector<std::string>& settings) const {
  std::vector<std::string> result = {"image.width=16", "image.height=16", "film.format=exact",
                                     fmt::format("render.recursion_level={}", recursion_level_)};
  result.insert(result.end(), settings.begin(), settings.end());
  return result;
}

MachineRun MachineScene::run(const std::vector<std::string>& settings) const {
  const Config config = resolve_config({}, all(settings));
  const std::string answer = run_in_child([&] { return run_here(config, scene_); }, kLimits);
  return run_of(answer);
}

}  // namespace sheaf::stability
