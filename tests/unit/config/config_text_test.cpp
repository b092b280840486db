// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/config_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "config/parameters.h"
#include "config/read_config.h"

namespace sheaf {
namespace {

Config configured(const std::vector<std::string>& settings) {
  return resolve_config(std::nullopt, settings);
}

Config read_back(const std::string& toml) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("sheaf_config_text_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file, std::ios::binary) << toml;
  const Config config = resolve_config(file, {});
  std::filesystem::remove(file);
  return config;
}

const std::vector<std::string>& unusual_settings() {
  static const std::vector<std::string> kSettings{
      "run.fidelity=clocked",
      "run.max_cycles=281474976710656",
      "image.heat_maps=rays,node_visits",
      "scene.reflectance=0.1",
      "scene.background=[1e-30, 0.1, 1e30]",
      "camera.name=\"tab\\t quote\\\" back\\\\slash \\u007f \\u00e9\"",
      "camera.position=[-0.0, 0.30000000000000004, -1e18]",
      "camera.yfov=33.3",
      "light.position=[1, 2, 3]",
      "clock.frequency=1234567890.123",
      "ray_cache.heuristic=pos(0.01)",
      "pos.relative=0.001",
      "l2.mode=absent",
      "film.format=exact",
      "dram.bytes_per_cycle=7",
      "kdtree.intersection_cost=80.5",
      "measure.coherence=true"};
  return kSettings;
}

TEST(ConfigText, WrittenConfigurationReadsBackTheSame) {
  for (const auto& settings : {std::vector<std::string>{}, unusual_settings()}) {
    const Config config = configured(settings);
    const std::string plain = config_toml(config, Comments::kNone);
    const std::string commented = config_toml(config, Comments::kMeanings);
    EXPECT_NE(plain, commented);
    EXPECT_EQ(config_toml(read_back(plain), Comments::kNone), plain);
    EXPECT_EQ(config_toml(read_back(commented), Comments::kNone), plain);
    EXPECT_EQ(config_hash(read_back(commented)), config_hash(config));
  }
}

TEST(ConfigText, TextsSurviveWritingAndReading) {
  const Config config = configured(unusual_settings());
  EXPECT_EQ(config.camera.name, "tab\t quote\" back\\slash \x7f \xc3\xa9");
  EXPECT_EQ(read_back(config_toml(config, Comments::kNone)).camera.name, config.camera.name);
}

TEST(ConfigText, EveryTableStandsOnce) {
  const std::string toml = config_toml(configured({}), Comments::kNone);
  const auto first = toml.find("[ray_cache]\n");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(toml.find("[ray_cache]\n", first + 1), std::string::npos);
}

TEST(ConfigText, LinesFitThePage) {
  for (const std::string& text :
       {config_toml(configured({}), Comments::kMeanings), describe_parameters()}) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100U) << line;
      EXPECT_FALSE(line.ends_with(' ')) << line;
    }
  }
}

TEST(ConfigText, EachParameterChangesTheHash) {
  const std::string usual = config_hash(configured({}));
  EXPECT_EQ(usual.size(), 32U);
  EXPECT_EQ(config_hash(configured({"image.width=640"})), usual);
  for (const std::string& setting : unusual_settings()) {
    EXPECT_NE(config_hash(configured({setting})), usual) << setting;
  }
}

TEST(ConfigText, EveryParameterIsDescribed) {
  Config config;
  const std::string text = describe_parameters();
  const ParameterTable table = declare_parameters(config);
  for (const Parameter& parameter : table.parameters()) {
    EXPECT_NE(text.find("  " + parameter.key + " = " + parameter.default_text), std::string::npos)
        << parameter.key;
  }
}

TEST(ConfigText, SchemaHoldsEveryParameterWithItsDefault) {
  Config config;
  const ParameterTable table = declare_parameters(config);
  const auto schema = nlohmann::json::parse(config_schema());
  for (const Parameter& parameter : table.parameters()) {
    const auto dot = parameter.key.find('.');
    const auto& group = schema.at("properties").at(parameter.key.substr(0, dot));
    EXPECT_EQ(group.at("additionalProperties"), false);
    const auto& entry = group.at("properties").at(parameter.key.substr(dot + 1));
    EXPECT_EQ(entry.at("default"), nlohmann::json::parse(parameter.default_text)) << parameter.key;
    EXPECT_TRUE(entry.at("description").get<std::string>().starts_with(parameter.meaning));
  }
  const auto& width = schema.at("properties").at("image").at("properties").at("width");
  EXPECT_EQ(width.at("type"), "integer");
  EXPECT_EQ(width.at("minimum"), 1);
  EXPECT_EQ(width.at("maximum"), 16384);
}

}  // namespace
}  // namespace sheaf
