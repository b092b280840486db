// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "base/errors.h"

namespace sheaf {

/// A large array that starts as zero bytes and need not fit into memory. A small one is ordinary
/// memory. A large one lies in a file without a name in the folder for temporary files; the pages
/// in use leave the process now and then, and the system writes them to the disk as it sees fit.
/// Throws Error(kOutput) if there is no room for the file, std::bad_alloc if there are no
/// addresses.
template <typename T>
class PagedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Arrays up to this size stay in memory.
  static constexpr std::size_t kInMemory = std::size_t{8} << 20U;

  explicit PagedArray(std::size_t size, std::size_t in_memory = kInMemory)
      : size_(size), paged_(size * sizeof(T) > in_memory) {
    const int file = paged_ ? temporary_file(bytes()) : -1;
    const int flags = paged_ ? MAP_SHARED : MAP_PRIVATE | MAP_ANONYMOUS;
    void* const memory = mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, flags, file, 0);
    if (file >= 0) close(file);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<T*>(memory);
  }
  PagedArray(PagedArray&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(other.size_), paged_(other.paged_) {}
  PagedArray(const PagedArray&) = delete;
  PagedArray& operator=(const PagedArray&) = delete;
  PagedArray& operator=(PagedArray&&) = delete;
  ~PagedArray() {
    if (data_ != nullptr) munmap(data_, bytes());
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator[](std::size_t i) {
    count_access();
    return data_[i];
  }
  [[nodiscard]] const T& operator[](std::size_t i) const {
    count_access();
    return data_[i];
  }

 private:
  // Often enough that what lies between is a few megabytes where accesses are near each other.
  static constexpr std::uint32_t kAccessesBetween = 1U << 17U;

  [[nodiscard]] std::size_t bytes() const { return (size_ == 0 ? 1 : size_) * sizeof(T); }
  void count_access() const {
    if (++num_accesses_ % kAccessesBetween == 0 && paged_) {
      madvise(data_, bytes(), MADV_DONTNEED);  // what a file holds is not lost by it
    }
  }
  static int temporary_file(std::size_t bytes) {
    std::error_code problem;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
    if (problem) refuse("the folder for temporary files", problem.value());
    std::string name = folder / "sheaf-pixels-XXXXXX";
    const int file = mkstemp(name.data());
    if (file < 0) refuse(folder, errno);
    unlink(name.c_str());
    const int reason = posix_fallocate(file, 0, static_cast<off_t>(bytes));
    if (reason == 0) return file;
    close(file);
    refuse(folder, reason);
  }
  [[noreturn]] static void refuse(const std::string& folder, int reason) {
    throw Error(ExitCode::kOutput, folder + ": no room for the pixels of a large picture: " +
                                       std::strerror(reason) + "; TMPDIR names another folder");
  }

  T* data_ = nullptr;
  std::size_t size_;
  bool paged_;
  mutable std::uint32_t num_accesses_ = 0;
};

}  // namespace sheaf
