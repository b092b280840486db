// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "scene/gltf_limits.h"

namespace sheaf::gltf {
namespace {

template <typename T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

int bytes_of_component(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// Bytes that `count` > 0 elements need behind the first one's offset; saturates.
std::uint64_t extent(std::uint64_t count, std::uint64_t stride, std::uint64_t element) {
  std::uint64_t result = 0;
  if (__builtin_mul_overflow(count - 1, stride, &result) ||
      __builtin_add_overflow(result, element, &result)) {
    return ~std::uint64_t{0};
  }
  return result;
}

const std::uint8_t* checked_start(ByteView bytes, std::uint64_t offset, std::uint64_t needed,
                                  const std::string& place, int view) {
  if (offset > bytes.size() || needed > bytes.size() - offset) {
    refuse(place, fmt::format("runs past bufferView {} of {} bytes; export the file again", view,
                              bytes.size()));
  }
  return bytes.data() + offset;
}

std::vector<std::uint32_t> load_indices(const std::uint8_t* base, std::uint64_t stride,
                                        std::uint64_t count, int type) {
  std::vector<std::uint32_t> result(count);
  const auto fill = [&]<typename T>(T) {
    for (std::uint64_t i = 0; i < count; ++i) result[i] = load<T>(base + i * stride);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      fill(std::uint8_t{});
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      fill(std::uint16_t{});
      break;
    default:
      fill(std::uint32_t{});
      break;
  }
  return result;
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

AccessorView::AccessorView(const Document& document, const std::string& place, int accessor)
    : place_(fmt::format("/accessors/{}", accessor)) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= document.model.accessors.size()) {
    refuse(place, fmt::format("there is no accessor {}", accessor));
  }
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  read_layout(source);
  if (count_ == 0) return;
  bind_base(document, source);
  if (source.sparse.isSparse) bind_sparse(document, source);
}

void AccessorView::read_layout(const tinygltf::Accessor& accessor) {
  component_type_ = accessor.componentType;
  component_bytes_ = bytes_of_component(component_type_);
  num_components_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  normalized_ = accessor.normalized;
  count_ = accessor.count;
  if (component_bytes_ == 0) {
    refuse(place_, fmt::format("componentType {} is not supported", component_type_));
  }
  if (num_components_ > 4 || accessor.type == TINYGLTF_TYPE_MAT2) {
    refuse(place_, "a matrix stands where numbers or vectors are expected");
  }
}

void AccessorView::bind_base(const Document& document, const tinygltf::Accessor& accessor) {
  const auto element =
      static_cast<std::uint64_t>(component_bytes_) * static_cast<std::uint64_t>(num_components_);
  stride_ = element;
  if (accessor.bufferView < 0) {
    if (count_ > kMaxZeroElements) {
      refuse(place_, fmt::format("{} elements without a bufferView are more than the {} allowed",
                                 count_, kMaxZeroElements));
    }
    return;
  }
  const ByteView bytes = buffer_view_bytes(document, place_, accessor.bufferView);
  const tinygltf::BufferView& view =
      document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (view.byteStride != 0) stride_ = view.byteStride;
  if (stride_ < element) {
    refuse(place_, fmt::format("byteStride {} of bufferView {} is less than an element of {} bytes",
                               stride_, accessor.bufferView, element));
  }
  base_ = checked_start(bytes, accessor.byteOffset, extent(count_, stride_, element), place_,
                        accessor.bufferView);
}

void AccessorView::bind_sparse(const Document& document, const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::uint64_t>(sparse.count) > count_) {
    refuse(place_ + "/sparse/count", fmt::format("{} is not in [1, {}]", sparse.count, count_));
  }
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    refuse(place_ + "/sparse", "a byteOffset is negative");
  }
  if (!is_index_type(sparse.indices.componentType)) {
    refuse(place_ + "/sparse/indices", fmt::format("componentType {} is not an unsigned integer",
                                                   sparse.indices.componentType));
  }
  const auto count = static_cast<std::uint64_t>(sparse.count);
  const auto index_bytes =
      static_cast<std::uint64_t>(bytes_of_component(sparse.indices.componentType));
  const auto element =
      static_cast<std::uint64_t>(component_bytes_) * static_cast<std::uint64_t>(num_components_);
  const std::string place = place_ + "/sparse";
  const std::uint8_t* indices =
      checked_start(buffer_view_bytes(document, place, sparse.indices.bufferView),
                    static_cast<std::uint64_t>(sparse.indices.byteOffset), count * index_bytes,
                    place + "/indices", sparse.indices.bufferView);
  sparse_values_ = checked_start(buffer_view_bytes(document, place, sparse.values.bufferView),
                                 static_cast<std::uint64_t>(sparse.values.byteOffset),
                                 count * element, place + "/values", sparse.values.bufferView);
  sparse_indices_ = load_indices(indices, index_bytes, count, sparse.indices.componentType);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (sparse_indices_[i] >= count_ || (i > 0 && sparse_indices_[i] <= sparse_indices_[i - 1])) {
      refuse(place + "/indices",
             fmt::format("index {} at {} is out of range or out of order", sparse_indices_[i], i));
    }
  }
}

const std::uint8_t* AccessorView::data_of(std::uint64_t i) const {
  if (!sparse_indices_.empty()) {
    const auto found = std::lower_bound(sparse_indices_.begin(), sparse_indices_.end(), i);
    if (found != sparse_indices_.end() && *found == i) {
      return sparse_values_ +
             (found - sparse_indices_.begin()) * component_bytes_ * num_components_;
    }
  }
  return base_ == nullptr ? nullptr : base_ + i * stride_;
}

double AccessorView::component(const std::uint8_t* bytes) const {
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(bytes);
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double value = load<std::int8_t>(bytes);
      return normalized_ ? std::max(value / 127.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return normalized_ ? load<std::uint8_t>(bytes) / 255.0 : load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double value = load<std::int16_t>(bytes);
      return normalized_ ? std::max(value / 32767.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return normalized_ ? load<std::uint16_t>(bytes) / 65535.0 : load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

std::vector<std::uint32_t> AccessorView::indices() const {
  if (num_components_ != 1 || normalized_ || !is_index_type(component_type_)) {
    refuse(place_, "indices must be scalars of an unsigned integer type");
  }
  if (base_ != nullptr && sparse_indices_.empty()) {
    return load_indices(base_, stride_, count_, component_type_);
  }
  std::vector<std::uint32_t> result(count_);
  for (std::uint64_t i = 0; i < count_; ++i) {
    result[i] = static_cast<std::uint32_t>(element<1>(i)[0]);
  }
  return result;
}

}  // namespace sheaf::gltf
