// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "kdtree/tree_cache.h"

#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

namespace sheaf {
namespace {

namespace fs = std::filesystem;

// To be raised whenever the builder comes to make another tree of the same scene.
constexpr std::uint32_t kBuilderVersion = 1;
constexpr std::string_view kSuffix = ".kdtree";
constexpr std::string_view kUnfinished = ".unfinished";
// A file that nobody has finished for so long was left behind by a process that was killed.
constexpr std::chrono::hours kAbandoned{1};

class Hash {
 public:
  Hash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }
  template <typename T>
  void add(std::span<const T> values) {
    XXH3_128bits_update(state_.get(), values.data(), values.size_bytes());
  }
  template <typename T>
  void add_value(const T& value) {
    add(std::span<const T>(&value, 1));
  }
  [[nodiscard]] std::string hex() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    std::string text;
    for (const unsigned char byte : canonical.digest) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += kDigits[byte / 16];
      text += kDigits[byte % 16];
    }
    return text;
  }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

struct KeptFile {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t size = 0;
};

// Files may vanish at any time: others tidy up too.
std::vector<KeptFile> list_files(const fs::path& folder) {
  std::vector<KeptFile> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    KeptFile file{at->path(), at->last_write_time(gone), 0};
    if (!gone) file.size = at->file_size(gone);
    if (!gone) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace

std::optional<fs::path> TreeCache::default_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache == '/') return fs::path(cache) / "sheaf";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return fs::path(home) / ".cache" / "sheaf";
  return {};
}

fs::path TreeCache::file_of(std::span<const Vec3> positions,
                            std::span<const std::array<std::uint32_t, 3>> triangles,
                            const KdBuildOptions& options) const {
  Hash hash;
  hash.add_value(kBuilderVersion);
  hash.add_value(options.traversal_cost);
  hash.add_value(options.intersection_cost);
  hash.add_value(options.empty_bonus);
  hash.add_value(options.max_depth);
  hash.add_value(positions.size());
  hash.add(positions);
  hash.add(triangles);
  return folder_ / (hash.hex() + std::string(kSuffix));
}

KdTree TreeCache::get(std::span<const Vec3> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles,
                      const KdBuildOptions& options) const {
  const fs::path file = file_of(positions, triangles, options);
  std::ifstream kept(file, std::ios::binary);
  if (std::optional<KdTree> tree = read_tree(kept, triangles.size())) {
    std::error_code read_only;
    fs::last_write_time(file, fs::file_time_type::clock::now(), read_only);
    return *std::move(tree);
  }
  KdTree tree = build_kd_tree(positions, triangles, options);
  keep(tree, file);
  return tree;
}

void TreeCache::keep(const KdTree& tree, const fs::path& file) const {
  const std::string bytes = to_bytes(tree);
  if (bytes.size() > limit_) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  fs::path unfinished = file;
  unfinished += '.';
  unfinished += std::to_string(getpid());
  unfinished += kUnfinished;
  {
    std::ofstream out(unfinished, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      fs::remove(unfinished, error);
      return;
    }
  }
  fs::rename(unfinished, file, error);
  if (error) fs::remove(unfinished, error);
  make_room();
}

void TreeCache::make_room() const {
  std::vector<KeptFile> trees;
  std::uintmax_t total = 0;
  std::error_code gone;
  for (KeptFile& file : list_files(folder_)) {
    const std::string name = file.path.filename().string();
    if (name.ends_with(kSuffix)) {
      total += file.size;
      trees.push_back(std::move(file));
    } else if (name.ends_with(kUnfinished) &&
               fs::file_time_type::clock::now() - file.used > kAbandoned) {
      fs::remove(file.path, gone);
    }
  }
  std::sort(trees.begin(), trees.end(),
            [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
  for (const KeptFile& tree : trees) {
    if (total <= limit_) return;
    fs::remove(tree.path, gone);
    total -= tree.size;
  }
}

}  // namespace sheaf
