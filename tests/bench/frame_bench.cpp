// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// How fast frames are simulated beside how fast Embree 3 merely traces the same rays one by one.
// Every measurement is a child process of its own, the kinds take turns, and the median counts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <cstdio>
#include <string>
#include <systemc>
#include <vector>

#include "bench/medians.h"
#include "config/read_config.h"
#include "scene/camera.h"
#include "scene/load_gltf.h"
#include "sorting/spawn_bundle.h"
#include "support/embree_oracle.h"
#include "system/analytic_model.h"
#include "system/functional_pipeline.h"
#include "system/machine.h"

namespace sheaf::bench {
namespace {

/// The rays of a frame: primary rays block by block of 4 x 4 pixels, each block followed by what it
/// spawns.
class FrameRays {
 public:
  FrameRays(const PreparedScene& scene, const Config& config)
      : scene_(scene),
        shader_(scene.scene, {config.render.recursion_level, 0.0F}, nullptr),
        packets_(kBlock * kBlock) {
    for (std::uint32_t y = 0; y < config.image.height; y += kBlock) {
      for (std::uint32_t x = 0; x < config.image.width; x += kBlock) {
        RayPacket& packet = *packets_.acquire();
        for (std::uint32_t i = 0; i < kBlock * kBlock; ++i) {
          packet.put(static_cast<int>(i),
                     primary_ray(scene.scene.camera, config.image.width, config.image.height,
                                 x + i % kBlock, y + i / kBlock));
        }
        follow(packet);
      }
    }
  }
  [[nodiscard]] const std::vector<Ray>& rays() const { return rays_; }

 private:
  static constexpr std::uint32_t kBlock = 4;
  void follow(RayPacket& packet) {
    for (LaneMask left = packet.active; left != 0; left &= left - 1) {
      rays_.push_back(packet.get(std::countr_zero(left)));
    }
    TraceCounts counts;
    trace_packet(TraversalScheme::kMasked, scene_.tree, scene_.triangles, packet, nullptr, nullptr,
                 counts);
    PacketShading shading;
    shader_.shade(packet, shading);
    packets_.release(&packet);
    std::vector<RayPacket*> spawned;
    split_by_kind(shading.spawned, packets_, spawned);
    for (RayPacket* secondary : spawned) follow(*secondary);
  }

  const PreparedScene& scene_;
  PacketShader shader_;
  PacketPool packets_;
  std::vector<Ray> rays_;
};

double embree_seconds(const test::EmbreeOracle& embree, const std::vector<Ray>& rays) {
  std::uint64_t hits = 0;
  const double start = cpu_seconds();
  for (const Ray& ray : rays) {
    if (ray.tag.kind == RayKind::kShadow) {
      hits += embree.occluded(ray) ? 1 : 0;
    } else {
      hits += embree.closest(ray).triangle != kNoHit ? 1 : 0;
    }
  }
  const double seconds = cpu_seconds() - start;
  if (hits == 0) throw std::runtime_error("Embree hits nothing");
  return seconds;
}

double functional_seconds(const Config& config, const BuildPlan& plan, const PreparedScene& scene) {
  const double start = cpu_seconds();
  Frame frame(config);
  FunctionalPipeline(config, plan, scene, frame).run({});
  return cpu_seconds() - start;
}

/// The functional run with every line that it touches looked up in the tags of the machine's
/// caches.
double analytic_seconds(const Config& config, const BuildPlan& plan, const PreparedScene& scene) {
  const double start = cpu_seconds();
  Frame frame(config);
  AnalyticModel model(config, scene);
  FunctionalPipeline pipeline(config, plan, scene, frame, {}, &model);
  model.run(pipeline, {});
  return cpu_seconds() - start;
}

double timed_seconds(const Config& config, const BuildPlan& plan, const PreparedScene& scene) {
  const double start = cpu_seconds();
  Frame frame(config);
  Machine machine(config, plan, scene, frame);
  machine.run({});
  return cpu_seconds() - start;
}

void measure_scene(const std::string& path, const Config& config, int repeats) {
  LoadedScene loaded = load_scene(path);
  const BuildPlan plan = plan_machine(config, loaded.scene.needs);
  const PreparedScene scene(std::move(loaded.scene), config);
  const std::vector<Ray> rays = FrameRays(scene, config).rays();
  const test::EmbreeOracle embree(scene.scene.positions, scene.scene.triangles,
                                  test::EmbreeOracle::Mode::kFast);

  std::vector<double> merely_traced;
  std::vector<double> functional;
  std::vector<double> analytic;
  std::vector<double> timed;
  for (int i = 0; i < repeats; ++i) {
    merely_traced.push_back(in_child([&] { return embree_seconds(embree, rays); }));
    functional.push_back(in_child([&] { return functional_seconds(config, plan, scene); }));
    analytic.push_back(in_child([&] { return analytic_seconds(config, plan, scene); }));
    timed.push_back(in_child([&] { return timed_seconds(config, plan, scene); }));
  }
  const double millions = static_cast<double>(rays.size()) * 1e-6;
  const std::string name = path.substr(path.find_last_of('/') + 1);
  fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n",
             name, millions, millions / median(merely_traced), millions / median(functional),
             millions / median(analytic), millions / median(timed),
             median(merely_traced) / median(timed), median(timed) / median(functional),
             median(analytic) / median(functional));
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  CLI::App app("Simulated rays a second, beside Embree's rays a second on the same rays");
  std::vector<std::string> scenes;
  std::vector<std::string> settings;
  int repeats = 5;
  app.add_option("SCENE", scenes, "glTF files")->required();
  app.add_option("--set", settings, "As in sheaf run")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--repeats", repeats, "Measurements of each kind; the median counts");
  CLI11_PARSE(app, argc, argv);
  settings.insert(settings.begin(), "render.recursion_level=3");
  const Config config = resolve_config({}, settings);
  fmt::print(
      "| scene | million rays | Embree | functional | analytic | timed | timed / Embree (speed) "
      "| timed / functional (time) | analytic / functional (time) |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::fflush(stdout);
  for (const std::string& scene : scenes) measure_scene(scene, config, repeats);
  return 0;
}

}  // namespace
}  // namespace sheaf::bench

int main(int argc, char** argv) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}

int sc_main(int argc, char** argv) {
  for (const char* message : {"/IEEE_Std_1666/deprecated", "/OSCI/SystemC"}) {
    sc_core::sc_report_handler::set_actions(message, sc_core::SC_DO_NOTHING);
  }
  return sheaf::bench::run(argc, argv);
}
