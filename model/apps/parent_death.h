// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

namespace sheaf {

/// Makes this process end with `parent`, which must be the process that started it: the kernel
/// kills it when the thread that started it ends (prctl(2), PR_SET_PDEATHSIG). So a sweep that is
/// killed leaves no simulation behind. Throws Error (kUsage) if it is not, or has ended already.
void end_with_parent(pid_t parent);

}  // namespace sheaf
