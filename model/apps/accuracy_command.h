// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sheaf {

struct AccuracyOptions {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> config;
  std::vector<std::string> settings;
  std::filesystem::path out;  ///< empty: result/accuracy
  std::string cache;          ///< see tree_folder()
  std::string reference = "clocked";
};

/// Declares `sheaf accuracy`, bound to `options`.
void declare_accuracy_command(CLI::App& app, AccuracyOptions& options);

/// `sheaf accuracy`: simulates one scene on one machine at every level of fidelity, with every film
/// format and with split planes and rays in fewer bits, and tells what each choice costs and how
/// far it is off. Returns an exit code; throws Error for what the user can mend.
int accuracy_command(const AccuracyOptions& options);

}  // namespace sheaf
