// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/units.h"
#include "scene/scene.h"
#include "system/prepared_scene.h"

namespace sheaf::stability {

/// What one machine made of a scene. It ran in a process of its own.
struct MachineRun {
  std::string error;  ///< empty if the frame was finished and every conservation law held
  ExitCode code = ExitCode::kOk;  ///< of that error; kBug if it is none that a user can mend
  Cycles cycles = 0;
  std::uint64_t picture = 0;  ///< hash of all pixels
  std::uint64_t rays = 0;     ///< hash of the ray counts by kind and depth
};

/// A scene prepared for pictures of 16 × 16 pixels in the exact film, `recursion_level` deep.
class MachineScene {
 public:
  /// A small one with two materials, mirrors, glass, a texture and a light.
  explicit MachineScene(std::uint32_t recursion_level);
  MachineScene(Scene scene, std::uint32_t recursion_level);
  /// `settings` are those of --set. A machine that takes more than a minute of processor time
  /// is taken to hang.
  [[nodiscard]] MachineRun run(const std::vector<std::string>& settings) const;

 private:
  [[nodiscard]] std::vector<std::string> all(const std::vector<std::string>& settings) const;
  std::uint32_t recursion_level_;
  PreparedScene scene_;
};

}  // namespace sheaf::stability
