// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

namespace sheaf {

/// Objects that are passed between units by pointer and reused.
template <typename T>
class ObjectPool {
 public:
  [[nodiscard]] T* acquire() {
    if (free_.empty()) {
      all_.push_back(std::make_unique<T>());
      free_.push_back(all_.back().get());
    }
    T* object = free_.back();
    free_.pop_back();
    return object;
  }
  void release(T* object) { free_.push_back(object); }
  [[nodiscard]] std::size_t num_out() const { return all_.size() - free_.size(); }

 private:
  std::vector<std::unique_ptr<T>> all_;
  std::vector<T*> free_;
};

}  // namespace sheaf
