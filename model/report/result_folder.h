// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "report/folder_lock.h"

namespace sheaf {

/// The folder of one run's results. Files are staged in a hidden folder inside it and moved to
/// their names by commit() at the end, stats.json last: a run that fails, is interrupted or is
/// killed leaves what was there before, and a stats.json tells that the result is whole.
class ResultFolder {
 public:
  /// Opens a new or empty folder, or a former result to be replaced, and proves that it can be
  /// written. Throws Error(kOutput) otherwise, for a folder with other things in it, and for one
  /// into which another run is writing.
  explicit ResultFolder(std::filesystem::path folder);

  /// Without commit(): removes what was staged, and the folders that the constructor made.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  /// Throws Error(kOutput) if commit() would replace or remove the file `input`.
  void spare(const std::filesystem::path& input) const;

  /// Where a writer that wants a file name shall write the result called `name`, one of those that
  /// result_folder.cpp lists.
  [[nodiscard]] std::filesystem::path stage(std::string_view name);

  /// Stages a file of these bytes; throws Error(kOutput) if they cannot be written.
  void write(std::string_view name, std::string_view bytes);

  /// Moves the staged files to their names; the former result's files that have no successor are
  /// removed, files that are no results stay. Throws Error(kOutput).
  void commit();

 private:
  void prepare();
  void remove_made_folders() noexcept;
  void move_staged(const std::string& name);
  void remove_result(const std::string& name);
  [[noreturn]] void fail(const std::string& problem) const;

  std::filesystem::path folder_, staging_;
  FolderLock lock_;
  std::vector<std::filesystem::path> made_;  ///< folders that did not exist, the outermost first
  std::vector<std::string> staged_;
};

}  // namespace sheaf
