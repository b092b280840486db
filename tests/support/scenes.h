// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace sheaf::test {

inline constexpr std::array<const char*, 5> kCommittedScenes{"dragon", "fairy", "newtree",
                                                             "oldtree", "sponza"};

/// Where one of the five committed scenes lies.
[[nodiscard]] std::filesystem::path committed_scene(const std::string& name);

/// Marko Dabrovic's Sponza, which is not part of the project: at the path that the environment
/// variable SHEAF_REAL_SPONZA gives, else in a folder shared/scenes beside the repository. Nothing
/// if it is not there.
[[nodiscard]] std::optional<std::filesystem::path> real_sponza();

}  // namespace sheaf::test
