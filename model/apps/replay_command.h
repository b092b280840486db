// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/observation.h"
#include "system/replay_machine.h"

namespace CLI {
class App;
}

namespace sheaf {

struct ReplayOptions {
  std::filesystem::path trace;
  std::optional<std::filesystem::path> scene;   ///< rays: instead of where it was recorded
  std::optional<std::filesystem::path> config;  ///< over the recorded configuration
  std::vector<std::string> settings;            ///< key=value, in order, over both
  std::optional<ReplayMode> mode;               ///< memory; elastic if not given
  std::filesystem::path out;                    ///< empty: result/replay
  std::string cache;                            ///< see tree_folder()
  bool quiet = false;                           ///< no summary on standard output
  std::optional<int> parent;                    ///< process with which the replay is to end
  WatchOptions watch;                           ///< rays
};

/// Declares `sheaf replay`, bound to `options`.
void declare_replay_command(CLI::App& app, ReplayOptions& options);

/// `sheaf replay`: runs a trace on another machine. Returns an exit code; throws Error for what the
/// user can mend.
int replay_command(const ReplayOptions& options);

}  // namespace sheaf
