// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The untimed kernels beside Embree 3's rtcIntersect1, one thread: the same camera rays, and the
// same incoherent rays from hit points in all directions, over the five scenes. Prints rays per
// second of each, and in the end the ratios of medians, which alone mean something on a busy
// machine.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "config/read_config.h"
#include "scene/camera.h"
#include "scene/load_gltf.h"
#include "support/embree_oracle.h"
#include "support/scenes.h"
#include "system/prepared_scene.h"

namespace sheaf::bench {
namespace {

constexpr int kPacketSize = 16;
constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 240;

/// A scene for both, and two sets of rays.
struct Workload {
  explicit Workload(const std::string& name)
      : scene(load_scene(test::committed_scene(name)).scene, resolve_config({}, {})),
        embree(scene.scene.positions, scene.scene.triangles, test::EmbreeOracle::Mode::kFast),
        robust(scene.scene.positions, scene.scene.triangles, test::EmbreeOracle::Mode::kRobust) {
    make_primary_rays();
    make_incoherent_rays();
  }

  PreparedScene scene;
  test::EmbreeOracle embree;
  test::EmbreeOracle robust;    ///< watertight, as Sheaf is
  std::vector<Ray> primary;     ///< block by block of 4 x 4 pixels
  std::vector<Ray> incoherent;  ///< one from each point that a camera ray met

 private:
  void make_primary_rays() {
    for (std::uint32_t y = 0; y < kHeight; y += 4) {
      for (std::uint32_t x = 0; x < kWidth; x += 4) {
        for (std::uint32_t i = 0; i < kPacketSize; ++i) {
          primary.push_back(primary_ray(scene.scene.camera, kWidth, kHeight, x + i % 4, y + i / 4));
        }
      }
    }
  }

  void make_incoherent_rays() {
    Random random(1);
    for (const Ray& ray : primary) {
      const auto hit = embree.closest(ray);
      if (hit.triangle == kNoHit) continue;
      Ray next = ray;
      const float z = 2.0F * random.uniform() - 1.0F;
      const float angle = 2.0F * std::numbers::pi_v<float> * random.uniform();
      const float radius = std::sqrt(1.0F - z * z);
      next.origin = ray.origin + 0.999F * hit.t * ray.direction;
      next.direction = {radius * std::cos(angle), radius * std::sin(angle), z};
      next.t_max = std::numeric_limits<float>::infinity();
      incoherent.push_back(next);
    }
  }
};

const std::vector<Ray>& rays_of(const Workload& workload, bool primary) {
  return primary ? workload.primary : workload.incoherent;
}

void trace_with_embree(benchmark::State& state, const test::EmbreeOracle& embree,
                       const Workload& workload, bool primary) {
  const std::vector<Ray>& rays = rays_of(workload, primary);
  for (auto _ : state) {
    for (const Ray& ray : rays) benchmark::DoNotOptimize(embree.closest(ray));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void trace_with_sheaf(benchmark::State& state, const Workload& workload, bool primary,
                      TraversalScheme scheme) {
  const std::vector<Ray>& rays = rays_of(workload, primary);
  RayPacket packet;
  TraceCounts counts;
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacketSize) {
      packet.clear(kPacketSize);
      const std::size_t end = std::min(begin + kPacketSize, rays.size());
      for (std::size_t i = begin; i < end; ++i) packet.put(static_cast<int>(i - begin), rays[i]);
      trace_packet(scheme, workload.scene.tree, workload.scene.triangles, packet, nullptr, nullptr,
                   counts);
      benchmark::DoNotOptimize(packet.hit_triangle[0]);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

/// Prints as the console does, and keeps the median of rays per second by name.
class Medians : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name != "median") continue;
      const auto rate = run.counters.find("items_per_second");
      if (rate != run.counters.end()) rates_[run.run_name.function_name] = rate->second;
    }
  }
  /// A table of speeds as parts of Embree's; a dash for what was not asked for.
  void print_ratios() const {
    fmt::print("| scene | primary, masked | single | Embree robust | incoherent, masked | single ");
    fmt::print("| Embree robust |\n| --- | --- | --- | --- | --- | --- | --- |\n");
    for (const char* scene : test::kCommittedScenes) {
      fmt::print("| {} |", scene);
      for (const char* rays : {"primary", "incoherent"}) {
        for (const char* kernel : {"masked", "single", "embree_robust"}) {
          const std::string name = fmt::format("{}/{}/", scene, rays);
          const auto ours = rates_.find(name + kernel);
          const auto embree = rates_.find(name + "embree");
          const bool measured = ours != rates_.end() && embree != rates_.end();
          fmt::print(" {} |",
                     measured ? fmt::format("{:.2f}", ours->second / embree->second) : "-");
        }
      }
      fmt::print("\n");
    }
  }

 private:
  std::map<std::string, double> rates_;
};

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Repetitions(5)
      ->MinTime(0.2)
      ->ReportAggregatesOnly();
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<Workload>> workloads;
  for (const char* scene : test::kCommittedScenes) {
    workloads.push_back(std::make_unique<Workload>(scene));
    const Workload& workload = *workloads.back();
    for (const bool primary : {true, false}) {
      const std::string name = fmt::format("{}/{}", scene, primary ? "primary" : "incoherent");
      add(name + "/embree", [&workload, primary](benchmark::State& state) {
        trace_with_embree(state, workload.embree, workload, primary);
      });
      add(name + "/embree_robust", [&workload, primary](benchmark::State& state) {
        trace_with_embree(state, workload.robust, workload, primary);
      });
      add(name + "/masked", [&workload, primary](benchmark::State& state) {
        trace_with_sheaf(state, workload, primary, TraversalScheme::kMasked);
      });
      add(name + "/single", [&workload, primary](benchmark::State& state) {
        trace_with_sheaf(state, workload, primary, TraversalScheme::kSingle);
      });
    }
  }
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  medians.print_ratios();
  return 0;
}

}  // namespace
}  // namespace sheaf::bench

int main(int argc, char** argv) {
  return sheaf::bench::run(argc, argv);
}
