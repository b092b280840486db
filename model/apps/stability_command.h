// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sheaf {

struct StabilityOptions {
  bool quick = false;
  std::string only;  ///< run the cases whose group or name contains this; empty: all
  std::string out;   ///< folder for stability.md and stability.csv; empty: none
};

/// Declares `sheaf stability`, bound to `options`.
void declare_stability_command(CLI::App& app, StabilityOptions& options);

/// `sheaf stability`: runs the catalogue of extreme and stiff cases and prints what it measured.
/// Returns 0 if every case passes, else 1.
int stability_command(const StabilityOptions& options);

}  // namespace sheaf
