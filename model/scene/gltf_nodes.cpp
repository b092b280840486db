// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_nodes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <ranges>

#include "geometry/vec.h"
#include "scene/gltf_limits.h"
#include "scene/gltf_value.h"

namespace sheaf::gltf {
namespace {

using glm::dmat4;
using glm::dquat;

dmat4 compose(const Vec3d& translation, const dquat& rotation, const Vec3d& scale) {
  dmat4 m = glm::mat4_cast(rotation);
  for (int i = 0; i < 3; ++i) m[i] *= scale[i];
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

/// glTF stores x, y, z, w. Quantized and sloppily written rotations are not quite unit.
dquat unit_rotation(double x, double y, double z, double w, const std::string& place) {
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 0.0) || !std::isfinite(length)) refuse(place, "the rotation has no direction");
  return {w / length, x / length, y / length, z / length};
}

void check_size(const std::vector<double>& numbers, std::size_t size, const std::string& place) {
  if (!numbers.empty() && numbers.size() != size) {
    refuse(place, fmt::format("has {} numbers, not {}", numbers.size(), size));
  }
}

dmat4 local_transform(const tinygltf::Node& node, const std::string& place) {
  check_size(node.matrix, 16, place + "/matrix");
  check_size(node.translation, 3, place + "/translation");
  check_size(node.rotation, 4, place + "/rotation");
  check_size(node.scale, 3, place + "/scale");
  if (!node.matrix.empty()) {
    dmat4 m{1.0};
    for (int column = 0; column < 4; ++column) {
      // A node's matrix is affine: its last row is (0, 0, 0, 1) whatever the file says.
      for (int row = 0; row < 3; ++row) m[column][row] = node.matrix[column * 4 + row];
    }
    return m;
  }
  const auto& t = node.translation;
  const auto& r = node.rotation;
  const auto& s = node.scale;
  return compose(t.empty() ? Vec3d(0.0) : Vec3d(t[0], t[1], t[2]),
                 r.empty() ? dquat(1.0, 0.0, 0.0, 0.0)
                           : unit_rotation(r[0], r[1], r[2], r[3], place + "/rotation"),
                 s.empty() ? Vec3d(1.0) : Vec3d(s[0], s[1], s[2]));
}

void read_attribute(const Document& document, const tinygltf::Value& attributes, const char* name,
                    int num_components, const std::string& place, AccessorView& view) {
  const int index = index_or_none(attributes, name, place);
  if (index < 0) return;
  view = AccessorView(document, place + "/" + name, index);
  if (view.num_components() != num_components) {
    refuse(view.place(), fmt::format("{} needs {} components", name, num_components));
  }
}

InstanceAttributes read_instances(const Document& document, const tinygltf::Node& node,
                                  const std::string& node_place) {
  InstanceAttributes result;
  const tinygltf::Value* extension = find_extension(node.extensions, "EXT_mesh_gpu_instancing");
  if (extension == nullptr || !extension->Has("attributes")) return result;
  const tinygltf::Value& attributes = extension->Get("attributes");
  const std::string place = node_place + "/extensions/EXT_mesh_gpu_instancing/attributes";
  read_attribute(document, attributes, "TRANSLATION", 3, place, result.translation);
  read_attribute(document, attributes, "ROTATION", 4, place, result.rotation);
  read_attribute(document, attributes, "SCALE", 3, place, result.scale);
  // An extension with custom attributes only still says how many instances there are.
  result.count = 0;
  for (const std::string& name : attributes.Keys()) {
    const AccessorView view(document, fmt::format("{}/{}", place, name),
                            index_or_none(attributes, name.c_str(), place));
    if (result.count != 0 && view.count() != result.count) {
      refuse(place, fmt::format("attributes of {} and {} instances", result.count, view.count()));
    }
    result.count = view.count();
  }
  return result;
}

class Walk {
 public:
  explicit Walk(const Document& document)
      : document_(document), reached_(document.model.nodes.size(), false) {}

  PlacedNodes run() {
    push(roots(), "/scenes", dmat4(1.0));
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      visit(next);
    }
    return std::move(placed_);
  }

 private:
  struct Pending {
    int node;
    dmat4 parent;
  };

  [[nodiscard]] std::vector<int> roots() const {
    const tinygltf::Model& model = document_.model;
    if (!model.scenes.empty()) {
      const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
      if (static_cast<std::size_t>(scene) >= model.scenes.size()) {
        refuse("/scene", fmt::format("there is no scene {}", scene));
      }
      return model.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
      for (const int child : node.children) {
        if (static_cast<std::size_t>(child) < is_child.size()) is_child[child] = true;
      }
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) result.push_back(static_cast<int>(i));
    }
    return result;
  }

  void push(const std::vector<int>& nodes, const std::string& place, const dmat4& parent) {
    for (const int node : std::ranges::reverse_view(nodes)) {
      if (node < 0 || static_cast<std::size_t>(node) >= reached_.size()) {
        refuse(place, fmt::format("there is no node {}", node));
      }
      pending_.push_back({node, parent});
    }
  }

  void visit(const Pending& next) {
    const std::string place = fmt::format("/nodes/{}", next.node);
    if (reached_[next.node]) {
      refuse(place, "is reached twice: its ancestors form a cycle, or it has two parents");
    }
    reached_[next.node] = true;
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(next.node)];
    const dmat4 world = next.parent * local_transform(node, place);
    if (node.mesh >= 0) {
      placed_.meshes.push_back({node.mesh, world, read_instances(document_, node, place)});
      // Bounds what the views of many instancing nodes hold, before triangles are counted.
      num_instances_ += placed_.meshes.back().instances.count;
      if (num_instances_ > kMaxTriangles) {
        refuse(place, fmt::format("the instances exceed the scene's limit of {}", kMaxTriangles));
      }
    }
    if (node.camera >= 0) placed_.cameras.push_back({node.camera, next.node, world});
    if (const tinygltf::Value* light = find_extension(node.extensions, "KHR_lights_punctual")) {
      const int index = index_or_none(*light, "light", place + "/extensions/KHR_lights_punctual");
      placed_.lights.push_back({index, next.node, world});
    }
    push(node.children, place + "/children", world);
  }

  const Document& document_;
  std::vector<bool> reached_;
  std::vector<Pending> pending_;
  PlacedNodes placed_;
  std::uint64_t num_instances_ = 0;
};

}  // namespace

glm::dmat4 InstanceAttributes::transform(std::uint64_t i) const {
  Vec3d t{0.0};
  Vec3d s{1.0};
  dquat r(1.0, 0.0, 0.0, 0.0);
  if (translation.count() != 0) {
    const auto v = translation.element<3>(i);
    t = Vec3d(v[0], v[1], v[2]);
  }
  if (rotation.count() != 0) {
    const auto v = rotation.element<4>(i);
    r = unit_rotation(v[0], v[1], v[2], v[3], rotation.place());
  }
  if (scale.count() != 0) {
    const auto v = scale.element<3>(i);
    s = Vec3d(v[0], v[1], v[2]);
  }
  return compose(t, r, s);
}

PlacedNodes place_nodes(const Document& document) {
  return Walk(document).run();
}

}  // namespace sheaf::gltf
