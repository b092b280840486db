// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <istream>
#include <memory>

#include "base/huge_pages.h"
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

/// XXH3 of a file's body, given piece by piece, and of its header.
class Checksum {
 public:
  Checksum() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  template <typename T>
  void add(std::span<const T> values) {
    XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
  }
  [[nodiscard]] std::uint64_t with(Header header) const {
    header.checksum = 0;
    return XXH3_64bits_withSeed(&header, sizeof header, XXH3_64bits_digest(state_.get()));
  }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// In pieces that are still in the processor's cache when they are hashed.
template <typename T>
bool read_values(std::istream& file, std::uint64_t count, std::vector<T>& values,
                 Checksum& checksum) {
  constexpr std::uint64_t kPiece = 1U << 15U;
  reserve_on_huge_pages(values, count);
  while (values.size() < count) {
    const std::size_t begin = values.size();
    values.resize(std::min(count, begin + kPiece));
    const std::span<T> piece = std::span(values).subspan(begin);
    if (!file.read(reinterpret_cast<char*>(piece.data()),
                   static_cast<std::streamsize>(piece.size_bytes()))) {
      return false;
    }
    checksum.add(std::span<const T>(piece));
  }
  return true;
}

std::uint64_t bytes_left(std::istream& file) {
  const std::streamoff begin = file.tellg();
  file.seekg(0, std::ios::end);
  const std::streamoff end = file.tellg();
  file.seekg(begin);
  return file ? static_cast<std::uint64_t>(end - begin) : 0;
}

/// The inner nodes on the longest path; none if this is not one tree of nodes that stand depth
/// first and of leaf lists in the same order, which no traversal leaves or goes too deep in.
std::optional<int> checked_depth(const KdTree& tree) {
  struct Subtree {
    std::size_t root;
    int depth;
  };
  std::array<Subtree, kMaxKdDepth + 1> ahead;  // right children; below them, the end of the tree
  ahead[0] = {tree.nodes.size(), 0};
  std::size_t num_ahead = 1;
  std::size_t num_references = 0;
  int depth = 0;
  int deepest = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const KdNode node = tree.nodes[i];
    if (node.is_leaf()) {
      if (node.first() != num_references || ahead[--num_ahead].root != i + 1) return {};
      num_references += node.count();
      depth = ahead[num_ahead].depth;
    } else {
      if (depth == kMaxKdDepth || !std::isfinite(node.split())) return {};
      ahead[num_ahead++] = {node.right_child(), ++depth};
      deepest = std::max(deepest, depth);
    }
  }
  if (num_ahead != 0 || num_references != tree.leaf_triangles.size()) return {};
  return deepest;
}

bool all_below(std::span<const std::uint32_t> triangles, std::uint64_t num_triangles) {
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](std::uint32_t triangle) { return triangle < num_triangles; });
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
  Checksum checksum;
  checksum.add(std::span<const char>(bytes).subspan(sizeof header));
  header.checksum = checksum.with(header);
  std::memcpy(bytes.data(), &header, sizeof header);
  return bytes;
}

std::optional<KdTree> read_tree(std::istream& file, std::uint64_t num_triangles) {
  Header header;
  const Header expected;
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header)) return {};
  const std::uint64_t body = bytes_left(file);
  if (header.magic != expected.magic || header.num_nodes == 0) return {};
  if (header.num_nodes > body / sizeof(KdNode) || header.num_references > body / 4) return {};
  if (header.num_nodes * sizeof(KdNode) + header.num_references * 4 != body) return {};
  KdTree tree;
  Checksum checksum;
  if (!read_values(file, header.num_nodes, tree.nodes, checksum)) return {};
  if (!read_values(file, header.num_references, tree.leaf_triangles, checksum)) return {};
  if (checksum.with(header) != header.checksum) return {};
  for (int axis = 0; axis < 3; ++axis) {
    tree.bounds.lo[axis] = header.bounds[static_cast<std::size_t>(axis)];
    tree.bounds.hi[axis] = header.bounds[static_cast<std::size_t>(axis) + 3];
  }
  const std::optional<int> depth = checked_depth(tree);
  if (!depth || !all_below(tree.leaf_triangles, num_triangles)) return {};
  tree.depth = *depth;
  return tree;
}

}  // namespace sheaf
