// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_primitive.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <numeric>

#include "scene/normals.h"

namespace sheaf::gltf {
namespace {

Vec3d to_vec(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// The vertex numbers of `count` triangles, three each; every second one of a strip is turned, so
/// that all wind the same way (glTF 2.0 specification, section 3.7.2.1).
std::vector<std::uint32_t> triangulate(std::vector<std::uint32_t> order, int mode,
                                       std::uint64_t count) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    order.resize(3 * count);
    return order;
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * count);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      corners.insert(corners.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    } else {
      corners.insert(corners.end(), {order[i + 1], order[i + 2], order[0]});
    }
  }
  return corners;
}

std::vector<std::uint32_t> read_order(const Document& document, const PlannedPrimitive& planned,
                                      std::uint64_t num_vertices) {
  if (planned.primitive->indices < 0) {
    std::vector<std::uint32_t> order(num_vertices);
    std::iota(order.begin(), order.end(), 0U);
    return order;
  }
  const AccessorView view(document, planned.place + "/indices", planned.primitive->indices);
  std::vector<std::uint32_t> order = view.indices();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= num_vertices) {
      refuse(view.place(), fmt::format("index {} at {} is out of range: {} has {} vertices",
                                       order[i], i, planned.place, num_vertices));
    }
  }
  return order;
}

bool is_integer(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

/// Attribute `name`; without it, a view of no elements.
AccessorView find_attribute(const Document& document, const PlannedPrimitive& planned,
                            const std::string& name, int num_components,
                            std::uint64_t num_vertices) {
  const auto found = planned.primitive->attributes.find(name);
  if (found == planned.primitive->attributes.end()) return {};
  AccessorView view(document, planned.place + "/attributes/" + name, found->second);
  const bool is_float = view.component_type() == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (view.num_components() != num_components ||
      (!is_float && !is_integer(view.component_type()))) {
    refuse(view.place(), fmt::format("has not the type of a {}", name));
  }
  if (num_vertices != 0 && view.count() != num_vertices) {
    refuse(view.place(),
           fmt::format("{} has {} elements for {} vertices", name, view.count(), num_vertices));
  }
  return view;
}

[[noreturn]] void refuse_vertex(const AccessorView& view, std::uint64_t vertex) {
  refuse(view.place(), fmt::format("element {} is not finite once placed in the scene", vertex));
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The transpose of the inverse times the determinant, which exists for singular matrices, too.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

}  // namespace

void PrimitiveWriter::write(const PlannedPrimitive& planned,
                            const std::vector<const PlacedMesh*>& placements,
                            std::uint16_t material, const std::optional<UvSource>& uvs) {
  const Shape shape = read_shape(planned, uvs);
  for (const PlacedMesh* placement : placements) {
    for (std::uint64_t i = 0; i < placement->instances.count; ++i) {
      write_instance(shape, placement->world * placement->instances.transform(i), material);
    }
  }
}

PrimitiveWriter::Shape PrimitiveWriter::read_shape(const PlannedPrimitive& planned,
                                                   const std::optional<UvSource>& uvs) {
  Shape shape;
  shape.positions = find_attribute(document_, planned, "POSITION", 3, 0);
  const std::uint64_t num_vertices = shape.positions.count();
  shape.normals = find_attribute(document_, planned, "NORMAL", 3, num_vertices);
  if (planned.primitive->attributes.contains("COLOR_0")) {
    document_.warnings.add("vertex colours are left out");
  }
  if (uvs) {
    const std::string name = fmt::format("TEXCOORD_{}", uvs->set);
    shape.uvs = find_attribute(document_, planned, name, 2, num_vertices);
    shape.uv_transform = uvs->transform;
    if (shape.uvs.count() == 0) {
      document_.warnings.add("textured primitives without texture coordinates show one texel");
    }
  }
  shape.corners = triangulate(read_order(document_, planned, num_vertices), planned.primitive->mode,
                              planned.triangles);
  if (shape.normals.count() == 0) {
    shape.vertices.swap(shape.corners);
  } else {
    share_vertices(shape, planned.max_vertices);
  }
  return shape;
}

void PrimitiveWriter::share_vertices(Shape& shape, std::uint64_t max_vertices) {
  if (slots_.size() < shape.positions.count()) slots_.resize(shape.positions.count());
  ++stamp_;
  shape.vertices.reserve(max_vertices);
  for (std::uint32_t& corner : shape.corners) {
    Slot& slot = slots_[corner];
    if (slot.stamp != stamp_) {
      slot = {stamp_, static_cast<std::uint32_t>(shape.vertices.size())};
      shape.vertices.push_back(corner);
    }
    corner = slot.vertex;
  }
}

void PrimitiveWriter::write_instance(const Shape& shape, const glm::dmat4& world,
                                     std::uint16_t material) {
  const std::size_t first_vertex = scene_.positions.size();
  const std::size_t first_triangle = scene_.triangles.size();
  const double determinant = glm::determinant(glm::dmat3(world));
  const bool mirrored = determinant < 0.0;
  write_positions(shape, world);
  write_normals(shape, world, mirrored ? -1.0 : 1.0);
  if (keep_uvs_) write_uvs(shape);
  const auto index = [&](std::size_t corner) {
    const std::size_t vertex = shape.corners.empty() ? corner : shape.corners[corner];
    return static_cast<std::uint32_t>(first_vertex + vertex);
  };
  const std::size_t num_corners =
      shape.corners.empty() ? shape.vertices.size() : shape.corners.size();
  for (std::size_t i = 0; i < num_corners; i += 3) {
    scene_.triangles.push_back(
        {index(i), index(mirrored ? i + 2 : i + 1), index(mirrored ? i + 1 : i + 2)});
  }
  scene_.triangle_material.resize(scene_.triangles.size(), material);
  fill_missing_normals(scene_, first_vertex, first_triangle);
}

void PrimitiveWriter::write_positions(const Shape& shape, const glm::dmat4& world) {
  const glm::dmat3 linear(world);
  const Vec3d translation(world[3]);
  for (const std::uint32_t vertex : shape.vertices) {
    const Vec3 p(linear * to_vec(shape.positions.element<3>(vertex)) + translation);
    if (!is_finite(p)) refuse_vertex(shape.positions, vertex);
    scene_.positions.push_back(p);
    scene_.bounds.add(p);
  }
}

void PrimitiveWriter::write_normals(const Shape& shape, const glm::dmat4& world, double side) {
  if (shape.normals.count() == 0) {
    scene_.normals.resize(scene_.positions.size(), Vec3(0.0F));
    return;
  }
  const glm::dmat3 m = cofactors(glm::dmat3(world)) * side;
  for (const std::uint32_t vertex : shape.vertices) {
    const Vec3d source = to_vec(shape.normals.element<3>(vertex));
    if (!is_finite(Vec3(source))) refuse_vertex(shape.normals, vertex);
    const Vec3d n = m * source;
    const double length = glm::length(n);
    // A normal of no length, in the file or through a zero scale, is made later, like a missing
    // one.
    const bool usable = length > 0.0 && std::isfinite(length);
    scene_.normals.push_back(usable ? Vec3(n / length) : Vec3(0.0F));
  }
}

void PrimitiveWriter::write_uvs(const Shape& shape) {
  if (shape.uvs.count() == 0) {
    scene_.uvs.resize(scene_.positions.size(), Vec2(0.0F));
    return;
  }
  for (const std::uint32_t vertex : shape.vertices) {
    const auto source = shape.uvs.element<2>(vertex);
    const Vec3 uv = shape.uv_transform *
                    Vec3(static_cast<float>(source[0]), static_cast<float>(source[1]), 1.0F);
    if (!is_finite(uv)) refuse_vertex(shape.uvs, vertex);
    scene_.uvs.emplace_back(uv.x, uv.y);
  }
}

}  // namespace sheaf::gltf
