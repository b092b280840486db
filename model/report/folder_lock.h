// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace sheaf {

/// A folder that one process at a time writes into. The system gives it back when the process ends,
/// however it ends. Where a file system knows no locks, every process gets one.
class FolderLock {
 public:
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Once, of a folder that is there; false if another lock of it lives.
  [[nodiscard]] bool take(const std::filesystem::path& folder);

 private:
  int file_ = -1;
};

}  // namespace sheaf
