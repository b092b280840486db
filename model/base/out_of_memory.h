// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sheaf {

/// How every refusal for want of memory ends, whichever part ran out of it. Programs that start
/// sheaf look for its first words (explore/src/sheaf_explore/task.py): the same run may succeed
/// where there is more memory.
inline constexpr const char* kOutOfMemory = "out of memory; choose a smaller picture or scene";

}  // namespace sheaf
