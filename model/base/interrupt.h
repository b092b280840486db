// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sheaf {

/// From now on SIGINT and SIGTERM ask what runs to end with what it has; a second one ends the
/// process.
void catch_interrupts();

/// Whether one has come. May be called from any thread.
[[nodiscard]] bool interrupted();

}  // namespace sheaf
