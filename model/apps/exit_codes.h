// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "base/errors.h"

namespace sheaf {

/// The line of a command's help that gives the exit codes it can end with: `codes`, and those of
/// every command (done, command line refused, result not written).
[[nodiscard]] std::string exit_codes(std::initializer_list<ExitCode> codes = {});

}  // namespace sheaf
