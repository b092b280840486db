// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/scenes.h"

#include <cstdlib>

namespace sheaf::test {

std::filesystem::path committed_scene(const std::string& name) {
  return std::filesystem::path(SHEAF_SOURCE_DIR) / "scenes" / (name + ".glb");
}

std::optional<std::filesystem::path> real_sponza() {
  const char* const given = std::getenv("SHEAF_REAL_SPONZA");
  std::filesystem::path path =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(SHEAF_SOURCE_DIR) / "../shared/scenes/sponza.glb";
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

}  // namespace sheaf::test
