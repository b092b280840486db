// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/units.h"

namespace sheaf {

// Values with units as a configuration writes them. Readers return nothing for text that is no such
// value, is negative, or does not fit; a space may stand between number and unit.

/// "32KiB", "4 MiB", "512B", "512": a whole number of bytes; units B, KiB, MiB, GiB, TiB (powers of
/// 1024).
[[nodiscard]] std::optional<Bytes> parse_bytes(std::string_view text);

/// The shortest text that parse_bytes reads back exactly: "32KiB", "100B".
[[nodiscard]] std::string format_bytes(Bytes bytes);

/// "1.5GHz", "800 MHz", "1e9": a finite frequency in hertz; units Hz, kHz, MHz, GHz, THz.
[[nodiscard]] std::optional<double> parse_frequency(std::string_view text);

/// Text that parse_frequency reads back exactly: "1.5GHz".
[[nodiscard]] std::string format_frequency(double hertz);

}  // namespace sheaf
