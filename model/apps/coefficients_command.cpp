// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/coefficients_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/exit_codes.h"
#include "base/errors.h"
#include "energy/coefficients.h"

namespace sheaf {

void declare_coefficients_command(CLI::App& app) {
  app.add_subcommand("coefficients",
                     "Print every coefficient of energy and area with unit, node and source")
      ->footer(exit_codes());
}

int coefficients_command() {
  std::fputs(print_coefficients().c_str(), stdout);
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
