// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/tree_cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "base/random.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  explicit Soup(std::uint32_t count, std::uint64_t seed = 1) {
    Random random(seed);
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
      positions.push_back({random.uniform(), random.uniform(), random.uniform()});
    }
    for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
};

std::optional<KdTree> from_bytes(const std::string& bytes, std::uint64_t num_triangles) {
  std::istringstream file(bytes);
  return read_tree(file, num_triangles);
}

bool same(const KdTree& a, const KdTree& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return equal(a.nodes, b.nodes) && equal(a.leaf_triangles, b.leaf_triangles) &&
         a.bounds.lo == b.bounds.lo && a.bounds.hi == b.bounds.hi && a.depth == b.depth;
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

struct Folder : testing::Test {
  fs::path path = fs::path(testing::TempDir()) / (std::string("trees_") + std::to_string(getpid()));
  void SetUp() override { fs::remove_all(path); }
  void TearDown() override { fs::remove_all(path); }
  [[nodiscard]] std::size_t num_files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

using TreeCacheFolder = Folder;

TEST_F(TreeCacheFolder, GivesTheTreeThatTheBuilderMakesEveryTime) {
  const Soup soup(500);
  const TreeCache cache(path);
  const KdTree built = build_kd_tree(soup.positions, soup.triangles);
  EXPECT_TRUE(same(cache.get(soup.positions, soup.triangles, {}), built));
  EXPECT_EQ(num_files(), 1U);
  EXPECT_TRUE(same(cache.get(soup.positions, soup.triangles, {}), built));
}

TEST_F(TreeCacheFolder, ReadsWhatItKept) {
  const Soup soup(500);
  const TreeCache cache(path);
  static_cast<void>(cache.get(soup.positions, soup.triangles, {}));
  // Another tree under this one's name shows that the file is what is used.
  const Soup other(500, 2);
  const KdTree foreign = build_kd_tree(other.positions, other.triangles);
  overwrite(cache.file_of(soup.positions, soup.triangles, {}), to_bytes(foreign));
  EXPECT_TRUE(same(cache.get(soup.positions, soup.triangles, {}), foreign));
}

TEST_F(TreeCacheFolder, NamesFilesByAllThatTheTreeDependsOn) {
  const Soup soup(50);
  Soup moved = soup;
  moved.positions[7].y += 0.25F;
  Soup turned = soup;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  const TreeCache cache(path);
  std::set<fs::path> names;
  names.insert(cache.file_of(soup.positions, soup.triangles, {}));
  names.insert(cache.file_of(moved.positions, moved.triangles, {}));
  names.insert(cache.file_of(turned.positions, turned.triangles, {}));
  names.insert(cache.file_of(soup.positions, soup.triangles, {.traversal_cost = 16.0}));
  names.insert(cache.file_of(soup.positions, soup.triangles, {.intersection_cost = 16.0}));
  names.insert(cache.file_of(soup.positions, soup.triangles, {.empty_bonus = 0.5}));
  names.insert(cache.file_of(soup.positions, soup.triangles, {.max_depth = 5}));
  EXPECT_EQ(names.size(), 7U);
  names.insert(cache.file_of(soup.positions, soup.triangles, {.threads = 2}));
  EXPECT_EQ(names.size(), 7U);
}

TEST_F(TreeCacheFolder, BuildsAnewWhatIsDamagedAndMendsIt) {
  const Soup soup(60);
  const TreeCache cache(path);
  const KdTree built = cache.get(soup.positions, soup.triangles, {});
  const fs::path file = cache.file_of(soup.positions, soup.triangles, {});
  const std::string whole = contents(file);
  overwrite(file, whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(same(cache.get(soup.positions, soup.triangles, {}), built));
  EXPECT_EQ(contents(file), whole);
}

TEST(TreeBytes, AreRefusedWithAnyByteChangedOrMissing) {
  const Soup soup(6);
  const std::string whole = to_bytes(build_kd_tree(soup.positions, soup.triangles));
  ASSERT_TRUE(from_bytes(whole, 6));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    EXPECT_FALSE(from_bytes(changed, 6)) << i;
    EXPECT_FALSE(from_bytes(whole.substr(0, i), 6)) << i;
  }
  EXPECT_FALSE(from_bytes(whole + '\0', 6));
}

bool refused(std::vector<KdNode> nodes, std::vector<std::uint32_t> triangles) {
  return !from_bytes(to_bytes({std::move(nodes), std::move(triangles), {}, 0}), 3);
}

TEST(TreeBytes, AreRefusedIfAWalkCouldLeaveTheTree) {
  const KdNode first = KdNode::leaf(0, 1);
  const KdNode second = KdNode::leaf(1, 1);
  EXPECT_FALSE(refused({KdNode::inner(0, 1.0F, 2), first, second}, {2, 2}));
  EXPECT_TRUE(refused({KdNode::inner(0, 1.0F, 3), first, second}, {2, 2}));
  EXPECT_TRUE(refused({KdNode::inner(0, 1.0F, 0), first, second}, {2, 2}));
  EXPECT_TRUE(refused({KdNode::inner(0, NAN, 2), first, second}, {2, 2}));
  EXPECT_TRUE(refused({KdNode::inner(0, 1.0F, 2), first, second}, {2, 3}));
  EXPECT_TRUE(refused({KdNode::inner(0, 1.0F, 2), first, second}, {2}));
  EXPECT_TRUE(refused({KdNode::inner(0, 1.0F, 2), first}, {2}));
}

TEST(TreeBytes, AreRefusedIfTheTreeIsTooDeep) {
  const auto spine = [](std::uint32_t depth) {
    std::vector<KdNode> nodes;
    for (std::uint32_t i = 0; i < depth; ++i) {
      nodes.push_back(KdNode::inner(0, 1.0F, 2 * depth - i));
    }
    nodes.resize(2 * depth + 1, KdNode::leaf(0, 0));
    return nodes;
  };
  EXPECT_FALSE(refused(spine(kMaxKdDepth), {}));
  EXPECT_TRUE(refused(spine(kMaxKdDepth + 1), {}));
}

// Fibonacci's number of ways lead down a tree whose right children are all part of the left ones.
TEST(TreeBytes, AreRefusedIfSubtreesAreShared) {
  std::vector<KdNode> nodes;
  for (std::uint32_t i = 0; i < 62; ++i) nodes.push_back(KdNode::inner(0, 1.0F, i + 2));
  nodes.resize(64, KdNode::leaf(0, 0));
  EXPECT_TRUE(refused(nodes, {}));
}

TEST(TreeBytes, AreRefusedIfLeafListsAreOutOfOrder) {
  const KdNode root = KdNode::inner(0, 1.0F, 2);
  const KdNode first = KdNode::leaf(0, 1);
  const KdNode second = KdNode::leaf(1, 1);
  EXPECT_FALSE(refused({root, first, second}, {0, 2}));
  EXPECT_TRUE(refused({root, second, first}, {0, 2}));
  EXPECT_TRUE(refused({root, first, first}, {0, 2}));
  EXPECT_TRUE(refused({root, first, second}, {0, 2, 1}));
  EXPECT_TRUE(refused({root, first, second, KdNode::leaf(2, 0)}, {0, 2}));
}

TEST_F(TreeCacheFolder, RemovesWhatWasUsedLongestAgo) {
  const Soup soup(200);
  const auto size = to_bytes(build_kd_tree(soup.positions, soup.triangles)).size();
  const TreeCache cache(path, 2 * size + size / 2);
  std::vector<fs::path> files;
  for (int depth = 20; depth < 23; ++depth) {  // deep enough to make no difference
    const KdBuildOptions options{.max_depth = depth};
    static_cast<void>(cache.get(soup.positions, soup.triangles, options));
    files.push_back(cache.file_of(soup.positions, soup.triangles, options));
    if (depth == 21) {
      fs::last_write_time(files[1], fs::file_time_type::clock::now() - std::chrono::hours(2));
    }
  }
  EXPECT_TRUE(fs::exists(files[0]));
  EXPECT_FALSE(fs::exists(files[1]));
  EXPECT_TRUE(fs::exists(files[2]));
}

TEST_F(TreeCacheFolder, TidiesUpAfterAKilledWriter) {
  fs::create_directories(path);
  const fs::path old = path / "x.kdtree.1.unfinished";
  const fs::path recent = path / "y.kdtree.2.unfinished";
  overwrite(old, "half");
  overwrite(recent, "half");
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
  const Soup soup(20);
  static_cast<void>(TreeCache(path).get(soup.positions, soup.triangles, {}));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(recent));
}

TEST_F(TreeCacheFolder, ServesWritersAtTheSameTime) {
  const Soup soup(300);
  const KdTree built = build_kd_tree(soup.positions, soup.triangles);
  std::vector<pid_t> children;
  for (int i = 0; i < 8; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      bool right = true;
      for (int round = 0; round < 20; ++round) {
        right = right && same(TreeCache(path).get(soup.positions, soup.triangles, {}), built);
        std::error_code gone;
        if (round % 3 == 0) {
          fs::remove(TreeCache(path).file_of(soup.positions, soup.triangles, {}), gone);
        }
      }
      _exit(right ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
}

TEST(TreeCacheElsewhere, BuildsWhenTheFolderCannotBeMade) {
  const Soup soup(20);
  const KdTree tree = TreeCache("/dev/null/trees").get(soup.positions, soup.triangles, {});
  EXPECT_TRUE(same(tree, build_kd_tree(soup.positions, soup.triangles)));
}

}  // namespace
}  // namespace sheaf
