// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/config.h"
#include "geometry/vec.h"
#include "system/prepared_scene.h"

namespace sheaf::test {

using Settings = std::vector<std::string>;  ///< key=value, as for --set

/// What one run left behind.
struct Outcome {
  std::string error;        ///< what stopped it, with SystemC's warnings; empty: nothing
  bool complete = false;    ///< the frame is complete
  std::vector<Vec3> image;  ///< linear RGB, row by row
  nlohmann::json stats;     ///< the content of stats.json

  /// A counter by its path; throws if there is none.
  [[nodiscard]] std::uint64_t count(const std::string& path) const;
  /// All entries whose paths begin with one of `prefixes`.
  [[nodiscard]] nlohmann::json entries(const std::vector<std::string>& prefixes) const;
};

/// A scene on which many machines are simulated, each in a process of its own, since SystemC keeps
/// one simulation a process: the scene is loaded and its tree built once, and the processes are
/// forked from there.
class TestScene {
 public:
  /// `base` holds for every run. What the prepared scene depends on (camera, lights, materials,
  /// tree, size of the image, format of the film) can be set only here.
  explicit TestScene(const std::filesystem::path& file, Settings base = {});
  /// A scene that was made and not loaded; its needs are found out here.
  explicit TestScene(Scene scene, Settings base = {});

  /// Simulates with `settings` on top of the base.
  [[nodiscard]] Outcome run(const Settings& settings = {}) const;

  /// The same with no unit running ahead of another.
  [[nodiscard]] Outcome run_in_step(const Settings& settings) const;

  /// Simulates with a configuration that need not be one that the reader accepts.
  [[nodiscard]] Outcome run(const Config& config) const;

  [[nodiscard]] const PreparedScene& prepared() const { return prepared_; }
  [[nodiscard]] const Config& base() const { return config_; }

 private:
  [[nodiscard]] Outcome run(const Config& config, bool in_step) const;

  Settings base_;
  Config config_;
  PreparedScene prepared_;
};

}  // namespace sheaf::test
