// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/observation.h"

namespace CLI {
class App;
}

namespace sheaf {

struct RunOptions {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> config;
  std::vector<std::string> settings;  ///< key=value, in order
  std::filesystem::path out;          ///< empty: result/<name of the scene>
  std::string cache;                  ///< see tree_folder()
  std::vector<std::string> record;    ///< kinds of trace to be written: rays, memory
  bool no_images = false;             ///< leave the pictures out
  bool quiet = false;                 ///< no summary on standard output
  std::optional<int> parent;          ///< process with which the run is to end
  WatchOptions watch;
};

/// Declares `sheaf run`, bound to `options`.
void declare_run_command(CLI::App& app, RunOptions& options);

/// `sheaf run`: loads, builds, simulates and writes the result folder. Returns an exit code; throws
/// Error for what the user can mend.
int run_command(const RunOptions& options);

/// `sheaf config --resolve`: every parameter as `sheaf run` would use it. Throws Error as that
/// would.
std::string resolved_config(const RunOptions& options);

struct InfoOptions {
  std::filesystem::path scene;
};

/// Declares `sheaf info`, bound to `options`.
void declare_info_command(CLI::App& app, InfoOptions& options);

/// `sheaf info`: prints what a scene holds and needs. Returns an exit code; throws Error for what
/// the user can mend.
int info_command(const InfoOptions& options);

}  // namespace sheaf
