// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// What the documents say of parameters, counters and files is there, and each unit's page says what
// a designer needs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "config/parameters.h"
#include "support/listed_counters.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"

namespace sheaf::test {
namespace {

namespace fs = std::filesystem;

struct Document {
  std::string name;  ///< relative to the repository
  std::vector<std::string> lines;
};

Document read_document(const fs::path& path) {
  Document document{path.lexically_relative(SHEAF_SOURCE_DIR).string(), {}};
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) document.lines.push_back(line);
  return document;
}

/// Every document of the project, in order of their names.
std::vector<Document> documents() {
  const fs::path root = SHEAF_SOURCE_DIR;
  std::set<fs::path> paths;
  for (const char* name :
       {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "scenes/README.md", "explore/README.md",
        "traces/README.md", "tests/bench/README.md", "tests/bench/README.md.in",
        "explore/src/sheaf_explore/paper/published/README.md"}) {
    paths.insert(root / name);
  }
  for (const char* folder : {"rtl_notes", "explore/docs"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() == ".md") paths.insert(entry.path());
    }
  }
  std::vector<Document> all;
  for (const fs::path& path : paths) all.push_back(read_document(path));
  return all;
}

std::vector<std::string> all_matches(const std::string& line, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

/// The keys of all parameters and the sections that they stand in.
struct Keys {
  Keys() {
    Config config;
    const ParameterTable table = declare_parameters(config);
    for (const Parameter& parameter : table.parameters()) {
      keys.insert(parameter.key);
      sections.insert(parameter.key.substr(0, parameter.key.find('.')));
    }
  }
  std::set<std::string> keys, sections;
};

/// First words of dotted names that can only be counters.
const std::set<std::string> kCounterRoots{"system", "trace", "coherence", "energy", "area", "rays"};

bool is_file_name(const std::string& token) {
  static const std::set<std::string> kExtensions{"md",    "h",   "cpp", "py",     "toml", "json",
                                                 "exr",   "png", "svg", "txt",    "glb",  "gltf",
                                                 "trace", "vcd", "csv", "parquet"};
  return kExtensions.contains(token.substr(token.rfind('.') + 1));
}

/// What is wrong with a dotted name that stands in a document as code; empty if nothing.
std::string wrong_name(const std::string& token, const Keys& keys, const ListedCounters& counters) {
  const std::string root = token.substr(0, token.find('.'));
  const bool may_be_key = keys.sections.contains(root);
  const bool may_be_counter = kCounterRoots.contains(root);
  if ((!may_be_key && !may_be_counter) || is_file_name(token)) return {};
  if (keys.keys.contains(token) || counters.has(token) || counters.has_group(token)) return {};
  return "neither a parameter nor a counter: " + token;
}

TEST(Documents, NameOnlyParametersAndCountersThatThereAre) {
  const Keys keys;
  const ListedCounters counters;
  // `key`, `key=value`, `key = value`; also what --set is given in an example.
  const std::regex code("`([a-z][a-z0-9_]*(?:\\.[a-z][a-z0-9_]*)+)(?: ?= ?[^`]*)?`");
  const std::regex set("--set ([a-z][a-z0-9_.]*)=");
  int names = 0;
  for (const Document& document : documents()) {
    for (std::size_t i = 0; i < document.lines.size(); ++i) {
      const std::string& line = document.lines[i];
      const std::string place = document.name + ':' + std::to_string(i + 1);
      for (const std::string& token : all_matches(line, code)) {
        EXPECT_EQ(wrong_name(token, keys, counters), "") << place;
        ++names;
      }
      for (const std::string& token : all_matches(line, set)) {
        EXPECT_TRUE(keys.keys.contains(token)) << place << ": no parameter: " << token;
      }
    }
  }
  EXPECT_GT(names, 200);
}

TEST(Documents, TheSearchForWrongNamesFindsThem) {
  const Keys keys;
  const ListedCounters counters;
  EXPECT_NE(wrong_name("ray_cache.cell", keys, counters), "");
  EXPECT_NE(wrong_name("system.ray_cache.num_hit", keys, counters), "");
  EXPECT_EQ(wrong_name("ray_cache.cells", keys, counters), "");
  EXPECT_EQ(wrong_name("system.traversal_unit0.node_cache.num_hits", keys, counters), "");
  EXPECT_EQ(wrong_name("image.png", keys, counters), "");
  EXPECT_EQ(wrong_name("derived.sram_bits", keys, counters), "");
}

/// The anchor that a heading gets: lower case, words joined by hyphens, no punctuation.
std::string anchor_of(std::string heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0) {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ' || c == '-') {
      anchor += '-';
    }
  }
  return anchor;
}

bool has_anchor(const fs::path& file, const std::string& anchor) {
  const Document document = read_document(file);
  return std::ranges::any_of(document.lines, [&](const std::string& line) {
    return line.starts_with('#') && anchor_of(line) == anchor;
  });
}

TEST(Documents, LinksLeadToFilesAndHeadings) {
  const std::regex link("\\]\\(([^) ]+)\\)");
  int links = 0;
  for (const Document& document : documents()) {
    const fs::path folder = (fs::path(SHEAF_SOURCE_DIR) / document.name).parent_path();
    for (std::size_t i = 0; i < document.lines.size(); ++i) {
      for (const std::string& target : all_matches(document.lines[i], link)) {
        if (target.find("://") != std::string::npos) continue;
        const std::string place = document.name + ':' + std::to_string(i + 1) + ": " + target;
        const std::size_t hash = target.find('#');
        const fs::path file = hash == 0 ? fs::path(SHEAF_SOURCE_DIR) / document.name
                                        : folder / target.substr(0, hash);
        EXPECT_TRUE(fs::exists(file)) << place;
        if (hash != std::string::npos && fs::exists(file)) {
          EXPECT_TRUE(has_anchor(file, target.substr(hash + 1))) << place;
        }
        ++links;
      }
    }
  }
  EXPECT_GT(links, 80);
}

/// The pages that the table of units in rtl_notes/README.md names.
std::vector<std::string> unit_pages() {
  std::vector<std::string> pages;
  const std::regex row("^\\| \\[[a-z0-9_]+\\]\\(([a-z0-9_]+\\.md)\\) \\|");
  for (const std::string& line :
       read_document(fs::path(SHEAF_SOURCE_DIR) / "rtl_notes/README.md").lines) {
    for (const std::string& page : all_matches(line, row)) pages.push_back(page);
  }
  return pages;
}

TEST(Documents, EveryUnitsPageSaysWhatADesignerNeeds) {
  const std::vector<std::string> pages = unit_pages();
  EXPECT_GE(pages.size(), 15U);
  for (const std::string& page : pages) {
    const Document document = read_document(fs::path(SHEAF_SOURCE_DIR) / "rtl_notes" / page);
    for (const char* part : {"## Ports", "## State", "## Pipeline", "## Throughput and latency",
                             "## What the model simplifies"}) {
      EXPECT_TRUE(std::ranges::any_of(
          document.lines, [&](const std::string& line) { return line.starts_with(part); }))
          << page << ": " << part;
    }
    std::string text;
    for (const std::string& line : document.lines) text += line + ' ';
    EXPECT_TRUE(std::regex_search(text, std::regex("limits? to the clock|limits? the clock")))
        << page << ": what limits the clock";
  }
}

TEST(Documents, ThePageOnEnergyHoldsTheTableOfCoefficients) {
  const CommandResult result = run_sheaf({"coefficients"});
  ASSERT_EQ(result.exit_code, 0);
  const std::string page = read_bytes(fs::path(SHEAF_SOURCE_DIR) / "rtl_notes/energy.md");
  EXPECT_NE(page.find("\n```\n" + result.out + "```\n"), std::string::npos)
      << "put the output of sheaf coefficients into rtl_notes/energy.md";
}

}  // namespace
}  // namespace sheaf::test
