// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "config/config_text.h"
#include "system/pipeline_parts.h"
#include "tracefile/scene_hash.h"

namespace sheaf {
namespace {

constexpr const char* kRaysName = "rays.trace";
constexpr const char* kMemoryName = "memory.trace";

bool wants(const std::vector<std::string>& kinds, const char* kind) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

}  // namespace

void check_recording(const std::vector<std::string>& kinds, const Config& config) {
  if (!kinds.empty() && config.run.fidelity == Fidelity::kSampled) {
    throw Error(ExitCode::kUsage,
                "--record: a sampled run is not recorded; set another run.fidelity");
  }
  if (wants(kinds, "memory") && config.run.fidelity != Fidelity::kTimed) {
    throw Error(ExitCode::kUsage,
                "--record memory: accesses have cycles only where time is simulated; set "
                "run.fidelity=timed");
  }
  if (wants(kinds, "memory") && config.flow.control == FlowPolicy::kSpill) {
    throw Error(ExitCode::kUsage,
                "--record memory: the traffic of spilled rays is not recorded; set "
                "flow.control=tile or credits");
  }
}

Recording::Rays::Rays(const std::filesystem::path& path, const TraceIdentity& identity,
                      const Config& config, const PreparedScene& scene, Frame& frame)
    : writer(path, identity),
      shader(make_shader(config, scene.scene, frame)),
      recorder(shader, writer, config.image.width, config.image.height, scene.scene.lights.size()) {
}

Recording::Recording(const RunOptions& options, const Config& config, const PreparedScene& scene,
                     Frame& frame, ResultFolder& folder) {
  metadata_.version = SHEAF_VERSION;
  metadata_.scene_name = options.scene.filename().string();
  metadata_.scene_path = options.scene.generic_string();
  metadata_.config = config_toml(config, Comments::kNone);
  metadata_.width = config.image.width;
  metadata_.height = config.image.height;
  metadata_.camera = scene.scene.camera;
  TraceIdentity identity{TraceKind::kRays, scene_hash(scene.scene),
                         hash_from_hex(config_hash(config))};
  if (wants(options.record, "rays")) {
    rays_.emplace(folder.stage(kRaysName), identity, config, scene, frame);
  }
  if (wants(options.record, "memory")) {
    identity.kind = TraceKind::kMemory;
    memory_.emplace(folder.stage(kMemoryName), identity);
  }
}

RunHooks Recording::hooks() {
  RunHooks hooks;
  if (rays_) hooks.shading = &rays_->recorder;
  if (memory_) hooks.memory = &memory_->recorder;
  return hooks;
}

bool Recording::failed() const {
  return (rays_ && rays_->writer.failed()) || (memory_ && memory_->writer.failed());
}

void Recording::finish(bool complete, const StatsTree& stats) {
  metadata_.complete = complete;
  metadata_.num_rays = stats.count("rays.num_retired");
  metadata_.cycles = stats.find("system.cycles") != nullptr ? stats.count("system.cycles") : 0;
  if (rays_) {
    rays_->recorder.flush();
    rays_->writer.finish(metadata_json(metadata_, TraceKind::kRays));
  }
  if (memory_) {
    memory_->recorder.flush();
    metadata_.memory = memory_->recorder.layout();
    memory_->writer.finish(metadata_json(metadata_, TraceKind::kMemory));
  }
}

}  // namespace sheaf
