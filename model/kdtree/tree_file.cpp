// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "kdtree/tree_cache.h"

namespace sheaf {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

struct Header {
  std::array<char, 8> magic{'S', 'H', 'E', 'A', 'F', 'K', 'D', '1'};
  std::uint64_t num_nodes = 0;
  std::uint64_t num_references = 0;
  std::array<float, 6> bounds{};
  std::uint64_t checksum = 0;  ///< XXH3 of everything behind it and, as 0, of the header
};
static_assert(sizeof(Header) == 56);

std::uint64_t checksum_of(std::string_view bytes, Header header) {
  header.checksum = 0;
  const std::uint64_t body =
      XXH3_64bits(bytes.data() + sizeof header, bytes.size() - sizeof header);
  return XXH3_64bits_withSeed(&header, sizeof header, body);
}

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// Children stand behind their parents, so one pass sees every way down. Returns the depth, or none
// if a traversal could leave the tree or overflow its stack.
std::optional<int> checked_depth(const KdTree& tree, std::uint64_t num_triangles) {
  std::vector<std::uint8_t> depth(tree.nodes.size(), 0);
  int deepest = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const KdNode node = tree.nodes[i];
    if (node.is_leaf()) {
      if (std::uint64_t{node.first()} + node.count() > tree.leaf_triangles.size()) return {};
      continue;
    }
    const std::size_t right = node.right_child();
    if (right <= i + 1 || right >= tree.nodes.size() || !std::isfinite(node.split())) return {};
    const int below = depth[i] + 1;
    if (below > kMaxKdDepth) return {};
    for (const std::size_t child : {i + 1, right}) {
      depth[child] = std::max(depth[child], static_cast<std::uint8_t>(below));
    }
    deepest = std::max(deepest, below);
  }
  const bool in_range =
      std::all_of(tree.leaf_triangles.begin(), tree.leaf_triangles.end(),
                  [&](std::uint32_t triangle) { return triangle < num_triangles; });
  if (!in_range) return {};
  return deepest;
}

}  // namespace

std::string to_bytes(const KdTree& tree) {
  Header header;
  header.num_nodes = tree.nodes.size();
  header.num_references = tree.leaf_triangles.size();
  for (int axis = 0; axis < 3; ++axis) {
    header.bounds[static_cast<std::size_t>(axis)] = tree.bounds.lo[axis];
    header.bounds[static_cast<std::size_t>(axis) + 3] = tree.bounds.hi[axis];
  }
  std::string bytes(sizeof header, '\0');
  append(bytes, tree.nodes);
  append(bytes, tree.leaf_triangles);
  header.checksum = checksum_of(bytes, header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

std::optional<KdTree> tree_from_bytes(std::string_view bytes, std::uint64_t num_triangles) {
  Header header;
  const Header expected;
  if (bytes.size() < sizeof header) return {};
  std::memcpy(&header, bytes.data(), sizeof header);
  const std::uint64_t body = bytes.size() - sizeof header;
  if (header.magic != expected.magic || header.num_nodes == 0) return {};
  if (header.num_nodes > body / sizeof(KdNode) || header.num_references > body / 4) return {};
  if (header.num_nodes * sizeof(KdNode) + header.num_references * 4 != body) return {};
  if (checksum_of(bytes, header) != header.checksum) return {};
  KdTree tree;
  const char* from = bytes.data() + sizeof header;
  tree.nodes.resize(header.num_nodes);
  std::memcpy(static_cast<void*>(tree.nodes.data()), from, header.num_nodes * sizeof(KdNode));
  from += header.num_nodes * sizeof(KdNode);
  tree.leaf_triangles.resize(header.num_references);
  std::memcpy(tree.leaf_triangles.data(), from, header.num_references * 4);
  for (int axis = 0; axis < 3; ++axis) {
    tree.bounds.lo[axis] = header.bounds[static_cast<std::size_t>(axis)];
    tree.bounds.hi[axis] = header.bounds[static_cast<std::size_t>(axis) + 3];
  }
  const std::optional<int> depth = checked_depth(tree, num_triangles);
  if (!depth) return {};
  tree.depth = *depth;
  return tree;
}

}  // namespace sheaf
