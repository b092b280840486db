// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace sheaf {

/// Declares `sheaf coefficients`.
void declare_coefficients_command(CLI::App& app);

/// `sheaf coefficients`: prints every coefficient of energy and area with value, unit, technology
/// node and source. Returns an exit code.
int coefficients_command();

}  // namespace sheaf
