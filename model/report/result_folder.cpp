// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <ranges>
#include <stdexcept>
#include <system_error>

#include "base/errors.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStagingName = ".sheaf-partial";
constexpr const char* kCompleteMark = "stats.json";

// Every file that any command leaves in a folder.
constexpr std::array kResultNames{"accuracy.csv",
                                  "accuracy.png",
                                  "accuracy.svg",
                                  "accuracy.txt",
                                  "config.toml",
                                  "curve.csv",
                                  "curve.png",
                                  "curve.svg",
                                  "heat_node_visits.png",
                                  "heat_rays.png",
                                  "heat_triangle_tests.png",
                                  "image.exr",
                                  "image.png",
                                  "image_error.csv",
                                  "image_error.png",
                                  "image_error.svg",
                                  "memory.trace",
                                  "precision.csv",
                                  "rays.trace",
                                  "signals.vcd",
                                  "stability.csv",
                                  "stability.md",
                                  "stats.json",
                                  "summary.txt",
                                  "timeline.perfetto-trace"};

/// A finished result, or one whose run was killed. A lone config.toml may be a user's own.
bool is_result(const fs::path& folder) {
  const auto has = [&](const char* name) {
    std::error_code ignored;
    return fs::exists(folder / name, ignored);
  };
  return has(kStagingName) || has("accuracy.csv") || has("curve.csv") || has("stability.csv") ||
         (has("config.toml") && has(kCompleteMark));
}

/// The folders that must be made for `folder` to exist, the outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) {
    missing.push_back(at);
    if (at == at.parent_path()) break;
  }
  std::ranges::reverse(missing);
  return missing;
}

fs::path without_trailing_slash(const fs::path& path) {
  const bool trailing = path.has_relative_path() && !path.has_filename();
  return trailing ? path.parent_path() : path;
}

}  // namespace

ResultFolder::ResultFolder(fs::path folder)
    : folder_(without_trailing_slash(std::move(folder))), staging_(folder_ / kStagingName) {
  try {
    prepare();
  } catch (const fs::filesystem_error& error) {
    remove_made_folders();
    fail(fmt::format("cannot write results here: {}; choose another folder with --out",
                     error.code().message()));
  }
}

void ResultFolder::prepare() {
  if (folder_.empty()) fail("the output folder has no name; give one with --out");
  if (fs::exists(folder_) && !fs::is_directory(folder_)) {
    fail("is no folder; choose another with --out");
  }
  for (const fs::path& missing : missing_folders(folder_)) {
    if (fs::create_directory(missing)) made_.push_back(missing);
  }
  if (!lock_.take(folder_)) {
    fail("another run is writing here; wait for its end, or choose another folder with --out");
  }
  if (!fs::is_empty(folder_) && !is_result(folder_)) {
    fail("holds files that are no result of Sheaf; choose a new folder with --out, or empty it");
  }
  fs::remove_all(staging_);
  fs::create_directory(staging_);
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  remove_made_folders();
}

void ResultFolder::remove_made_folders() noexcept {
  // Those with a result in them are not empty, and stay.
  std::error_code ignored;
  for (const fs::path& made : std::ranges::reverse_view(made_)) fs::remove(made, ignored);
}

void ResultFolder::spare(const fs::path& input) const {
  std::error_code ignored;
  for (const char* name : kResultNames) {
    if (!fs::equivalent(folder_ / name, input, ignored)) continue;
    fail(
        fmt::format("holds {}, which the results made of it would replace; choose another folder "
                    "with --out",
                    input.filename().string()));
  }
}

fs::path ResultFolder::stage(std::string_view name) {
  if (std::ranges::find(kResultNames, name) == kResultNames.end()) {
    throw std::logic_error(fmt::format("{} is not listed as the name of a result", name));
  }
  if (std::ranges::find(staged_, name) == staged_.end()) staged_.emplace_back(name);
  return staging_ / name;
}

void ResultFolder::write(std::string_view name, std::string_view bytes) {
  std::ofstream stream(stage(name), std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) fail(fmt::format("cannot write {}; is the disk full?", name));
}

void ResultFolder::commit() {
  try {
    remove_result(kCompleteMark);
    for (const char* name : kResultNames) {
      if (std::ranges::find(staged_, name) == staged_.end()) remove_result(name);
    }
    const bool completes = std::erase(staged_, kCompleteMark) > 0;
    for (const std::string& name : staged_) move_staged(name);
    if (completes) move_staged(kCompleteMark);
    staged_.clear();
    fs::remove_all(staging_);
  } catch (const fs::filesystem_error& error) {
    fail(fmt::format("cannot put the results in place: {}", error.code().message()));
  }
}

void ResultFolder::move_staged(const std::string& name) {
  fs::rename(staging_ / name, folder_ / name);
}

void ResultFolder::remove_result(const std::string& name) {
  fs::remove(folder_ / name);
}

void ResultFolder::fail(const std::string& problem) const {
  throw Error(ExitCode::kOutput, fmt::format("{}: {}", folder_.string(), problem));
}

}  // namespace sheaf
