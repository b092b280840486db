// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <ranges>
#include <system_error>

#include "base/errors.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStagingName = ".sheaf-partial";
constexpr const char* kCompleteMark = "stats.json";
constexpr std::array kResultNames{"config.toml",     "stats.json",
                                  "image.exr",       "image.png",
                                  "summary.txt",     "rays.trace",
                                  "memory.trace",    "stability.md",
                                  "stability.csv",   "timeline.perfetto-trace",
                                  "signals.vcd",     "accuracy.txt",
                                  "accuracy.csv",    "accuracy.svg",
                                  "accuracy.png",    "image_error.csv",
                                  "image_error.svg", "image_error.png"};

/// A finished result, or one whose run was killed. A lone config.toml may be a user's own.
bool is_result(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / kStagingName, ignored) ||
         fs::exists(folder / "stability.csv", ignored) ||
         fs::exists(folder / "accuracy.csv", ignored) ||
         (fs::exists(folder / "config.toml", ignored) &&
          fs::exists(folder / kCompleteMark, ignored));
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
  if (fs::exists(folder_)) {
    if (!fs::is_directory(folder_)) {
      fail("is no folder; choose another with --out");
    }
    if (!fs::is_empty(folder_) && !is_result(folder_)) {
      fail("holds files that are no result of Sheaf; choose a new folder with --out, or empty it");
    }
  }
  for (const fs::path& missing : missing_folders(folder_)) {
    if (fs::create_directory(missing)) made_.push_back(missing);
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

fs::path ResultFolder::stage(std::string_view name) {
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
