// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace sheaf::stability {

/// Rows in which every choice of levels of any `strength` factors occurs: a covering array. Row r
/// gives factor f the level rows[r][f] < levels[f]. Greedy, one row at a time, the best of some
/// candidates (after Cohen, Dalal, Fredman and Patton, "The AETG system", IEEE TSE 23(7), 1997);
/// the same for the same arguments. `strength` is 1, 2 or 3, and no more than there are factors.
[[nodiscard]] std::vector<std::vector<std::size_t>> covering_array(
    const std::vector<std::size_t>& levels, std::size_t strength);

}  // namespace sheaf::stability
