// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "apps/frame_run.h"
#include "apps/run_command.h"
#include "shading/packet_shader.h"
#include "tracefile/memory_recorder.h"
#include "tracefile/ray_recorder.h"
#include "tracefile/trace_metadata.h"
#include "tracefile/trace_writer.h"

namespace sheaf {

/// Throws Error(kUsage) for what cannot be recorded under this configuration.
void check_recording(const std::vector<std::string>& kinds, const Config& config);

/// Writes the traces of one run into its result folder: rays.trace, memory.trace.
class Recording final : public FrameGuest {
 public:
  Recording(const RunOptions& options, const Config& config, const PreparedScene& scene,
            Frame& frame, ResultFolder& folder);

  [[nodiscard]] RunHooks hooks() override;
  [[nodiscard]] bool failed() const override;
  void finish(bool complete, const StatsTree& stats) override;

 private:
  struct Rays {
    Rays(const std::filesystem::path& path, const TraceIdentity& identity, const Config& config,
         const PreparedScene& scene, Frame& frame);
    TraceWriter writer;
    PacketShader shader;
    RayRecorder recorder;
  };
  TraceMetadata metadata_;
  struct Memory {
    Memory(const std::filesystem::path& path, const TraceIdentity& identity)
        : writer(path, identity), recorder(writer) {}
    TraceWriter writer;
    MemoryRecorder recorder;
  };
  std::optional<Rays> rays_;
  std::optional<Memory> memory_;
};

}  // namespace sheaf
