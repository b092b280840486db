// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace sheaf {

/// Writes a whole file. Throws Error(kOutput, "<path>: <reason>") if that fails, and leaves no
/// half-written file behind.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace sheaf
