// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/parent_death.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>

#include "base/errors.h"

namespace sheaf {

void end_with_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A parent that ended before the line above sends no signal any more.
  if (getppid() != parent) {
    throw Error(ExitCode::kUsage,
                fmt::format("--parent {}: this is not the process that started the run", parent));
  }
}

}  // namespace sheaf
