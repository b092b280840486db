// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/calendar.h"

#include <fmt/format.h>

#include "base/errors.h"

namespace sheaf {

void Calendar::refuse_time(Cycles time) {
  throw Error(ExitCode::kUsage,
              fmt::format("cycle {}: a run ends before cycle 2^52 = {}; simulate less, or choose "
                          "shorter latencies and intervals",
                          time, kEndOfTime));
}

}  // namespace sheaf
