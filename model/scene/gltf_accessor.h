// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf_document.h"

namespace sheaf::gltf {

/// A checked window on an accessor's elements: every element lies within its buffer, whatever the
/// offset, stride, count and sparse part that the file states. Lives no longer than the document.
class AccessorView {
 public:
  AccessorView() = default;
  /// `place` names who refers to the accessor.
  AccessorView(const Document& document, const std::string& place, int accessor);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] int num_components() const { return num_components_; }
  [[nodiscard]] int component_type() const { return component_type_; }
  [[nodiscard]] bool normalized() const { return normalized_; }
  [[nodiscard]] const std::string& place() const { return place_; }

  /// The first kCount components of element i < count(), as real numbers; normalized integers are
  /// mapped to [0, 1] or [-1, 1] (glTF 2.0 specification, section 3.11, "Animations", table of
  /// integer encodings). kCount <= num_components().
  template <int kCount>
  [[nodiscard]] std::array<double, kCount> element(std::uint64_t i) const {
    const std::uint8_t* bytes = data_of(i);
    std::array<double, kCount> result{};
    if (bytes == nullptr) return result;
    for (int c = 0; c < kCount; ++c) {
      result[c] = component(bytes + std::ptrdiff_t{c} * component_bytes_);
    }
    return result;
  }

  /// All elements of a scalar accessor of unsigned integers.
  [[nodiscard]] std::vector<std::uint32_t> indices() const;

 private:
  void read_layout(const tinygltf::Accessor& accessor);
  void bind_base(const Document& document, const tinygltf::Accessor& accessor);
  void bind_sparse(const Document& document, const tinygltf::Accessor& accessor);
  [[nodiscard]] const std::uint8_t* data_of(std::uint64_t i) const;
  [[nodiscard]] double component(const std::uint8_t* bytes) const;

  std::string place_;
  const std::uint8_t* base_ = nullptr;  ///< null: all zeros
  std::uint64_t stride_ = 0;
  std::uint64_t count_ = 0;
  int num_components_ = 0;
  int component_bytes_ = 0;
  int component_type_ = 0;
  bool normalized_ = false;
  std::vector<std::uint32_t> sparse_indices_;  ///< ascending
  const std::uint8_t* sparse_values_ = nullptr;
};

}  // namespace sheaf::gltf
