// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/accuracy/precision.h"

#include <algorithm>
#include <bit>

#include "image/compare.h"
#include "system/functional_pipeline.h"
#include "system/pipeline_parts.h"
#include "traversal/reduced_precision.h"

namespace sheaf {
namespace {

constexpr int kRayNumbers = 6;  // origin and inverse direction

double share_added(std::uint64_t count, std::uint64_t full) {
  return full == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(full) - 1.0;
}

/// Shades what the walk in fewer bits finds instead of what the machine found.
class Retracer final : public ShadingSource {
 public:
  /// Traces every `stride`-th packet again.
  Retracer(ShadingSource& shader, const PreparedScene& scene, const ReducedPrecision& precision,
           std::uint64_t stride)
      : shader_(shader), scene_(scene), precision_(precision), stride_(stride) {}

  void shade(const RayPacket& packet, PacketShading& out) override {
    if (num_packets_++ % stride_ != 0) {
      shader_.shade(packet, out);
      return;
    }
    packet_ = packet;
    for (LaneMask left = packet.active; left != 0; left &= left - 1) {
      retrace(std::countr_zero(left));
    }
    shader_.shade(packet_, out);
  }

  [[nodiscard]] std::uint64_t num_rays() const { return num_rays_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t tests() const { return tests_; }
  [[nodiscard]] std::uint64_t differing() const { return differing_; }

 private:
  void retrace(int lane) {
    const Ray ray = packet_.get(lane);
    const ReducedTrace found = trace_reduced(precision_, scene_.tree, scene_.triangles, ray);
    ++num_rays_;
    steps_ += found.steps;
    tests_ += found.tests;
    const auto i = static_cast<std::size_t>(lane);
    const bool same = ray.tag.kind == RayKind::kShadow
                          ? (found.triangle == kNoHit) == (packet_.hit_triangle[i] == kNoHit)
                          : found.triangle == packet_.hit_triangle[i] &&
                                found.t == packet_.hit_t[i] && found.u == packet_.hit_u[i] &&
                                found.v == packet_.hit_v[i];
    differing_ += same ? 0 : 1;
    packet_.hit_triangle[i] = found.triangle;
    packet_.hit_t[i] = found.t;
    packet_.hit_u[i] = found.u;
    packet_.hit_v[i] = found.v;
  }

  ShadingSource& shader_;
  const PreparedScene& scene_;
  const ReducedPrecision precision_;
  const std::uint64_t stride_;
  RayPacket packet_;
  std::uint64_t num_packets_ = 0, num_rays_ = 0;
  std::uint64_t steps_ = 0, tests_ = 0, differing_ = 0;
};

class Experiment {
 public:
  Experiment(Config config, const PreparedScene& scene, const std::function<bool()>& stop)
      : config_(std::move(config)), scene_(scene), stop_(stop), space_(scene.tree.bounds) {
    config_.run.fidelity = Fidelity::kFunctional;
    space_.add(scene.scene.camera.position);
  }

  PrecisionCosts run() {
    render_plain();
    add("nothing", kFullPrecision, {});
    for (const NumberFormat& format : kReducedFormats) {
      add("planes", format, {format, kFullPrecision, space_});
      add("rays", format, {kFullPrecision, format, space_});
      add("both", format, {format, format, space_});
    }
    if (stop_()) costs_.rows.clear();
    return costs_;
  }

 private:
  std::vector<Vec3> render(const RunHooks& hooks, Frame& frame) {
    const BuildPlan plan = plan_machine(config_, scene_.scene.needs);
    FunctionalPipeline pipeline(config_, plan, scene_, frame, hooks);
    pipeline.run([&](double /*progress*/) { return stop_(); });
    std::vector<Vec3> picture;
    for (std::uint32_t i = 0; i < config_.image.width * config_.image.height; ++i) {
      picture.push_back(frame.film->value(i));
    }
    return picture;
  }

  void render_plain() {
    Frame frame(config_);
    machines_picture_ = render({}, frame);
    costs_.num_rays = frame.rays.total().spawned;
    stride_ =
        std::max<std::uint64_t>(1, (costs_.num_rays + kMostPrecisionRays - 1) / kMostPrecisionRays);
  }

  /// The first row added is what the others are compared with.
  void add(const char* stored, const NumberFormat& format, const ReducedPrecision& precision) {
    Frame frame(config_);
    PacketShader shader = make_shader(config_, scene_.scene, frame);
    Retracer retracer(shader, scene_, precision, stride_);
    RunHooks hooks;
    hooks.shading = &retracer;
    const std::vector<Vec3> picture = render(hooks, frame);
    if (costs_.rows.empty()) {
      full_steps_ = retracer.steps();
      full_tests_ = retracer.tests();
      costs_.num_traced = retracer.num_rays();
    }
    costs_.rows.push_back({stored, format.name, kFullPrecision.bits - precision.planes.bits,
                           kRayNumbers * (kFullPrecision.bits - precision.rays.bits),
                           share_added(retracer.steps(), full_steps_),
                           share_added(retracer.tests(), full_tests_), retracer.differing(),
                           compare_images(picture, machines_picture_).rmse});
  }

  Config config_;
  const PreparedScene& scene_;
  const std::function<bool()>& stop_;
  Box space_;  ///< where rays start
  std::vector<Vec3> machines_picture_;
  std::uint64_t stride_ = 1;
  std::uint64_t full_steps_ = 0, full_tests_ = 0;
  PrecisionCosts costs_;
};

}  // namespace

PrecisionCosts precision_costs(const Config& config, const PreparedScene& scene,
                               const std::function<bool()>& stop) {
  return Experiment(config, scene, stop).run();
}

}  // namespace sheaf
