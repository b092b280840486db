// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// The rules of the house: rooms use only rooms above them, SystemC stays below the algorithms,
// every file carries its licence.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 19> kRooms{
    "base",    "config",  "stats",  "geometry",  "scene",    "kdtree", "traversal",
    "sorting", "shading", "image",  "tracefile", "channels", "memory", "units",
    "system",  "energy",  "report", "stability", "apps"};

std::size_t floor_of(std::string_view room) {
  return static_cast<std::size_t>(std::ranges::find(kRooms, room) - kRooms.begin());
}

bool is_systemc(std::string_view header) {
  return header == "systemc" || header == "systemc.h" || header == "tlm" || header == "tlm.h" ||
         header.starts_with("tlm_") || header.starts_with("sysc/");
}

/// What is wrong with one line of a file in `room`; empty if nothing.
std::string wrong_include(std::string_view room, std::string_view line) {
  if (!line.starts_with("#include ") || line.size() < 11) return {};
  const char opening = line[9];
  const std::string_view rest = line.substr(10);
  const std::string_view header = rest.substr(0, rest.find_first_of("\">"));
  if (is_systemc(header)) {
    return floor_of(room) < floor_of("channels") ? "SystemC starts at channels/" : "";
  }
  if (opening != '"') return {};
  const std::string_view target = header.substr(0, header.find('/'));
  if (floor_of(target) == kRooms.size()) return "write the path relative to model/";
  return floor_of(target) > floor_of(room) ? "this room is further down" : "";
}

struct SourceFile {
  std::string path;  ///< relative to the repository
  std::vector<std::string> lines;
};

std::vector<SourceFile> sources_below(const std::string& folder) {
  const fs::path root = SHEAF_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".h" && path.extension() != ".cpp" &&
        path.filename() != "CMakeLists.txt") {
      continue;
    }
    files.push_back({path.lexically_relative(root), {}});
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) files.back().lines.push_back(line);
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

std::vector<SourceFile> all_sources() {
  std::vector<SourceFile> files = sources_below("model");
  std::ranges::move(sources_below("tests"), std::back_inserter(files));
  return files;
}

TEST(House, TheRulesOnIncludesFindWhatBreaksThem) {
  EXPECT_EQ(wrong_include("sorting", "#include \"units/shader_unit.h\""),
            "this room is further down");
  EXPECT_EQ(wrong_include("sorting", "#include \"sorter.h\""), "write the path relative to model/");
  EXPECT_EQ(wrong_include("sorting", "#include <systemc>"), "SystemC starts at channels/");
  EXPECT_EQ(wrong_include("sorting", "#include <tlm_core/tlm_2/tlm_generic_payload.h>"),
            "SystemC starts at channels/");
  EXPECT_EQ(wrong_include("sorting", "#include \"sorting/sorter.h\""), "");
  EXPECT_EQ(wrong_include("sorting", "#include \"base/units.h\""), "");
  EXPECT_EQ(wrong_include("sorting", "#include <vector>"), "");
  EXPECT_EQ(wrong_include("channels", "#include <systemc>"), "");
}

TEST(House, IncludesPointOnlyToRoomsAbove) {
  const std::vector<SourceFile> files = sources_below("model");
  ASSERT_FALSE(files.empty());
  for (const SourceFile& file : files) {
    const std::string inside = file.path.substr(std::string_view("model/").size());
    if (inside == "CMakeLists.txt") continue;
    const std::string room = inside.substr(0, inside.find('/'));
    EXPECT_LT(floor_of(room), kRooms.size()) << file.path << ": this room is not in the house";
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      EXPECT_EQ(wrong_include(room, file.lines[i]), "")
          << file.path << ':' << i + 1 << ": " << file.lines[i];
    }
  }
}

TEST(House, EveryFileCarriesItsLicence) {
  for (const SourceFile& file : all_sources()) {
    ASSERT_GE(file.lines.size(), 2U) << file.path;
    EXPECT_NE(file.lines[0].find("SPDX-FileCopyrightText: "), std::string::npos) << file.path;
    EXPECT_NE(file.lines[1].find("SPDX-License-Identifier: Apache-2.0"), std::string::npos)
        << file.path;
  }
}

// A long file now and then has its reasons; a house of long files has none.
TEST(House, FewFilesAreLong) {
  constexpr std::size_t kLong = 500;
  const std::vector<SourceFile> files = all_sources();
  std::size_t num_long = 0;
  for (const SourceFile& file : files) {
    if (file.lines.size() <= kLong) continue;
    ++num_long;
    std::cout << file.path << " has " << file.lines.size() << " lines\n";
  }
  EXPECT_LE(num_long * 20, files.size()) << "more than one file in twenty is over 500 lines";
}

}  // namespace
