// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/errors.h"
#include "gltf_builder.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;

TEST(RefuseFile, MissingFileAndFolder) {
  const TempFolder folder;
  expect_refused(folder.path() / "none.glb", {"no such file"});
  expect_refused(folder.path(), {"is a folder"});
}

TEST(RefuseFile, NotAGltf) {
  const TempFolder folder;
  const fs::path path = folder.path() / "scene.gltf";
  for (const char* text : {"", "hello", "  ", "[1]", "\x89PNG"}) {
    write_text(path, text);
    expect_refused(path, {"not a glTF file"});
  }
  write_text(path, R"({"a": 1})");
  expect_refused(path, {"/asset/version", "not a glTF 2.0 file"});
  write_text(path, R"({"asset": {"version": "1.0"}})");
  expect_refused(path, {"/asset/version", "1.0", "convert"});
}

TEST(RefuseFile, BrokenJsonNamesLineAndColumn) {
  const TempFolder folder;
  write_text(folder.path() / "scene.gltf", "{\n\"asset\": }");
  expect_refused(folder.path() / "scene.gltf", {"broken JSON", "line 2"});
}

/// Loads or refuses, never anything else; returns whether it was refused.
bool is_refused(const fs::path& path) {
  try {
    (void)load_scene(path);
    return false;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kScene);
    return true;
  }
}

void set_word(std::vector<std::uint8_t>& bytes, std::size_t offset, std::uint64_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[offset + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

TEST(RefuseFile, GlbTruncatedAtAnyByte) {
  const TempFolder folder;
  const fs::path path = folder.path() / "scene.glb";
  const std::vector<std::uint8_t> whole = one_triangle().glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    write_bytes(path, cut);
    EXPECT_TRUE(is_refused(path)) << size;
    // The same with a header that agrees with the size, so that the inner lengths are tested.
    if (size < 12) continue;
    set_word(cut, 8, size);
    write_bytes(path, cut);
    EXPECT_TRUE(is_refused(path)) << size;
  }
  write_bytes(path, whole);
  EXPECT_FALSE(is_refused(path));
}

TEST(RefuseFile, AnyByteOfAGlbMayBeWrong) {
  const TempFolder folder;
  const fs::path path = folder.path() / "scene.glb";
  const std::vector<std::uint8_t> whole = one_triangle().glb();
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int wrong : {0x00, 0xFF, 0x39, whole[i] ^ 0x01}) {
      std::vector<std::uint8_t> bytes = whole;
      bytes[i] = static_cast<std::uint8_t>(wrong);
      write_bytes(path, bytes);
      refused += is_refused(path) ? 1 : 0;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(RefuseFile, GlbHeader) {
  const TempFolder folder;
  const fs::path path = folder.path() / "scene.glb";
  const std::vector<std::uint8_t> whole = one_triangle().glb();
  std::vector<std::uint8_t> bytes = whole;
  set_word(bytes, 4, 1);
  write_bytes(path, bytes);
  expect_refused(path, {"GLB version 1"});
  bytes = whole;
  bytes.push_back(0);
  write_bytes(path, bytes);
  expect_refused(path, {"header states"});
  bytes = whole;
  bytes.pop_back();
  write_bytes(path, bytes);
  expect_refused(path, {"truncated GLB"});
  bytes = whole;
  set_word(bytes, 16, 0x004E4942);
  write_bytes(path, bytes);
  expect_refused(path, {"not JSON"});
}

TEST(RefuseFile, BinaryChunkMayNotClaimTheBytesOfItsHeader) {
  // Exactly the off-by-eight that lets a reader run past the end of the file.
  const TempFolder folder;
  const fs::path path = folder.path() / "scene.glb";
  std::vector<std::uint8_t> bytes = one_triangle().glb();
  const std::size_t json_end = 20 + (bytes[12] | std::size_t{bytes[13]} << 8);
  set_word(bytes, json_end, bytes.size() - json_end);
  write_bytes(path, bytes);
  expect_refused(path, {"GLB chunk", "past the end"});
}

void expect_uri_refused(const std::string& uri, std::string_view word) {
  const TempFolder outer;
  const fs::path folder = outer.path() / "inner";
  fs::create_directory(folder);
  const GltfBuilder file = one_triangle();
  // The file is there: only the rule keeps it from being read.
  write_bytes(outer.path() / "data.bin", file.binary);
  write_text(folder / "scene.gltf", file.gltf(uri));
  expect_refused(folder / "scene.gltf", {"/buffers/0/uri", word});
}

TEST(RefuseFile, UrisThatLeaveTheFolder) {
  expect_uri_refused("../data.bin", "scene's folder; put");
  expect_uri_refused("%2e%2e/data.bin", "scene's folder; put");
  expect_uri_refused("..%2Fdata.bin", "scene's folder; put");
  expect_uri_refused("sub/../../data.bin", "scene's folder; put");
  expect_uri_refused("..\\data.bin", "scene's folder; put");
  expect_uri_refused("/etc/hostname", "scene's folder; put");
  expect_uri_refused("file:///etc/hostname", "not a file");
  expect_uri_refused("http://example.org/data.bin", "not a file");
  expect_uri_refused("", "not a file name");
  expect_uri_refused("a%00b", "not a file name");
  expect_uri_refused("missing.bin", "no such file");
  expect_uri_refused("inner/../inner.bin", "scene's folder; put");
  expect_uri_refused(".", "is a folder");
}

TEST(RefuseFile, LinksThatLeaveTheFolder) {
  const TempFolder outer;
  const fs::path folder = outer.path() / "inner";
  fs::create_directory(folder);
  const GltfBuilder file = one_triangle();
  write_bytes(outer.path() / "data.bin", file.binary);
  fs::create_symlink(outer.path() / "data.bin", folder / "link.bin");
  write_text(folder / "scene.gltf", file.gltf("link.bin"));
  expect_refused(folder / "scene.gltf", {"/buffers/0/uri", "through a link"});
  fs::create_directory_symlink(outer.path(), folder / "up");
  write_text(folder / "scene.gltf", file.gltf("up/data.bin"));
  expect_refused(folder / "scene.gltf", {"/buffers/0/uri", "through a link"});
}

TEST(RefuseFile, ImageUrisAreHeldToTheSameRuleEvenIfUnused) {
  GltfBuilder file = one_triangle();
  file.root["images"] = json::array({{{"uri", "../secret.png"}}});
  expect_refused(file, {"/images/0/uri", "folder"});
}

TEST(RefuseFile, BufferShorterThanItsByteLength) {
  GltfBuilder file = one_triangle();
  file.root["buffers"] = json::array({{{"byteLength", 1000}}});
  expect_refused(file, {"/buffers/0", "1000", "36"});
  file.root["buffers"] = json::array({{{"byteLength", 36}}, {{"byteLength", 36}}});
  expect_refused(file, {"/buffers/1", "neither a uri nor"});
  file.root["buffers"] = json::array({{{"byteLength", 36}, {"uri", "data:x;base64,!!!"}}});
  expect_refused(file, {"/buffers/0/uri", "base64"});
  file.root["buffers"] = json::array({{{"byteLength", 36}, {"uri", "data:text/plain,abc"}}});
  expect_refused(file, {"/buffers/0/uri", "base64"});
}

}  // namespace
}  // namespace sheaf::test
