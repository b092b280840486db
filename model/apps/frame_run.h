// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "report/result_folder.h"
#include "stats/report_tree.h"
#include "system/frame.h"
#include "system/machine_observer.h"
#include "system/prepared_scene.h"
#include "system/run_hooks.h"

namespace sheaf {

/// The folder that --cache names: TreeCache::default_folder() if empty, none if "none".
[[nodiscard]] std::optional<std::filesystem::path> tree_folder(const std::string& option);

/// Loads a scene as the configuration has it, with notes on standard error, and prepares it.
/// Throws Error for what the user can mend.
[[nodiscard]] PreparedScene prepare_scene(const std::filesystem::path& file, const Config& config,
                                          const std::optional<std::filesystem::path>& trees);

/// What a run has come to.
struct RunResult {
  const Config& config;
  const StatsTree& stats;
  const std::string& summary;
  bool complete = true;
  const char* unreached = "";  ///< completes "stopped before ..."
  bool quiet = false;          ///< no summary on standard output
};

/// Writes configuration, summary and counters beside what the folder holds, makes it appear, and
/// says so. Returns an exit code; throws Error(kOutput).
int finish_run(const RunResult& result, ResultFolder& folder);

/// Something that takes part in a run: a recorder, or a trace in the shader's place.
class FrameGuest {
 public:
  virtual ~FrameGuest() = default;
  [[nodiscard]] virtual RunHooks hooks() = 0;
  /// The run is of no use any more and should stop.
  [[nodiscard]] virtual bool failed() const = 0;
  /// After the run, before its results are written. Throws what made failed() true.
  virtual void finish(bool complete, const StatsTree& stats) = 0;
};

struct FrameJob {
  const Config& config;
  std::filesystem::path scene;
  std::string scene_name;  ///< as the report gives it
  bool images = true;      ///< write pictures
  bool quiet = false;      ///< no summary on standard output
  /// Called once the scene is loaded; may be null.
  std::function<std::unique_ptr<FrameGuest>(const PreparedScene&, Frame&)> guest;
  std::optional<std::filesystem::path> trees = {};  ///< folder of the TreeCache; none: no cache
  std::vector<MachineObserver*> observers = {};     ///< of a timed run
};

/// Loads the scene, builds, simulates and writes the result folder. Returns an exit code; throws
/// Error for what the user can mend.
int run_frame(const FrameJob& job, ResultFolder& folder);

}  // namespace sheaf
