// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "memory/private_cache.h"

namespace sheaf {

// Laws of conservation: each throws Error(kBug) naming the law that does not hold.

void require(bool holds, const std::string& law);
void require_equal(std::uint64_t a, std::uint64_t b, const std::string& law);
/// Accesses = hits + misses + merges.
void check_cache(const std::string& name, const CacheStats& stats);

}  // namespace sheaf
