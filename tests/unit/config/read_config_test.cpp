// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/read_config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/errors.h"
#include "base/random.h"
#include "config/config_text.h"

namespace sheaf {
namespace {

namespace fs = std::filesystem;

class ReadConfig : public testing::Test {
 protected:
  ReadConfig() {
    folder_ = fs::temp_directory_path() / ("sheaf_read_config_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    fs::current_path(folder_);
  }
  ~ReadConfig() override {
    fs::current_path("/");
    fs::remove_all(folder_);
  }

  static Config read(const std::string& toml, const std::vector<std::string>& settings = {}) {
    std::ofstream("run.toml", std::ios::binary) << toml;
    return resolve_config("run.toml", settings);
  }

  static Config set(const std::vector<std::string>& settings) {
    return resolve_config(std::nullopt, settings);
  }

  /// The message with which `attempt` is refused.
  template <typename Attempt>
  static std::string refusal(Attempt attempt) {
    try {
      static_cast<void>(attempt());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line";
      return message;
    }
    return "accepted";
  }
  static std::string refusal_of_file(const std::string& toml) {
    return refusal([&] { return read(toml); });
  }
  static std::string refusal_of_setting(const std::string& setting) {
    return refusal([&] { return set({setting}); });
  }

  fs::path folder_;
};

TEST_F(ReadConfig, DottedKeysAndTablesMeanTheSame) {
  const Config dotted = read("ray_cache.cells = 96\nl2.capacity = \"1MiB\"\n");
  const Config tables = read("[ray_cache]\ncells = 96\n[l2]\ncapacity = 1048576\n");
  const Config in_line = read("ray_cache = { cells = 96 }\nl2 = { capacity = \"1024KiB\" }\n");
  EXPECT_EQ(dotted.ray_cache.cells, 96U);
  EXPECT_EQ(dotted.l2.capacity, 1048576U);
  EXPECT_EQ(config_hash(dotted), config_hash(tables));
  EXPECT_EQ(config_hash(dotted), config_hash(in_line));
}

TEST_F(ReadConfig, SettingsOverrideTheFileAndEachOther) {
  const Config config =
      read("image.width = 100\nimage.height = 100\n", {"image.width=200", "image.width=300"});
  EXPECT_EQ(config.image.width, 300U);
  EXPECT_EQ(config.image.height, 100U);
}

TEST_F(ReadConfig, SettingsNeedNoQuotes) {
  const Config config =
      set({"ray_cache.heuristic=mdir(96)", "flow.control=credits", "l2.capacity=1 MiB",
           "clock.frequency=1.5GHz", "camera.position=1, 2,3.5", "camera.look_at=[0,0,0]",
           "scene.reflectance=0.5", "run.keep_all=true", "camera.name=7"});
  EXPECT_EQ(config.ray_cache.heuristic, "mdir(96)");
  EXPECT_EQ(config.flow.control, FlowPolicy::kCredits);
  EXPECT_EQ(config.l2.capacity, 1048576U);
  EXPECT_EQ(config.clock.frequency, 1.5e9);
  EXPECT_EQ(config.camera.position, (Triple{1, 2, 3.5}));
  EXPECT_EQ(config.camera.look_at, (Triple{0, 0, 0}));
  EXPECT_EQ(config.scene.reflectance, 0.5);
  EXPECT_TRUE(config.run.keep_all);
  EXPECT_EQ(config.camera.name, "7");
}

TEST_F(ReadConfig, SettingsMayHaveQuotesAndAnEqualsSign) {
  EXPECT_EQ(set({"camera.name=\"a \\\"b\\\"\""}).camera.name, "a \"b\"");
  EXPECT_EQ(set({"camera.name=a=b"}).camera.name, "a=b");
  EXPECT_EQ(set({"camera.name="}).camera.name, "");
}

TEST_F(ReadConfig, UnknownKeyNamesPlaceAndNearestKey) {
  EXPECT_EQ(refusal_of_file("image.width = 8\nray_cache.cell = 1\n"),
            "run.toml:2: unknown key 'ray_cache.cell'; did you mean 'ray_cache.cells'?");
  EXPECT_EQ(refusal_of_file("\n\n[ray_cach]\ncells = 1\n"),
            "run.toml:4: unknown key 'ray_cach.cells'; did you mean 'ray_cache.cells'?");
  EXPECT_EQ(refusal_of_file("\"ray_cache.cells\" = 1\n"),
            "run.toml:1: unknown key '\"ray_cache.cells\"'; did you mean 'ray_cache.cells'?");
  EXPECT_EQ(refusal_of_setting("width=5"),
            "--set width=5: unknown key 'width'; did you mean 'image.width'?");
  EXPECT_EQ(refusal_of_setting("frobnicate.everything=5"),
            "--set frobnicate.everything=5: unknown key 'frobnicate.everything'; `sheaf config` "
            "lists all keys");
}

TEST_F(ReadConfig, TheFirstBadLineOfTheFileIsTold) {
  EXPECT_EQ(refusal_of_file("[l2]\nline = 0\n[image]\nwidth = 0\n").substr(0, 11), "run.toml:2:");
  EXPECT_EQ(refusal_of_file("[image]\nwidth = 0\n[l2]\nline = 0\n").substr(0, 11), "run.toml:2:");
}

TEST_F(ReadConfig, ValuesOutOfRangeTellPlaceRangeAndUnit) {
  EXPECT_EQ(refusal_of_file("packet.size = 65\n"),
            "run.toml:1: packet.size: 65 is out of range; allowed: 1 to 64 rays");
  EXPECT_EQ(refusal_of_setting("packet.size=65"),
            "--set packet.size=65: packet.size: 65 is out of range; allowed: 1 to 64 rays");
}

TEST_F(ReadConfig, NanAndInfinityAreRefused) {
  for (const char* value : {"nan", "inf", "-inf", "+nan"}) {
    EXPECT_NE(refusal_of_file(std::string("kdtree.empty_bonus = ") + value), "accepted") << value;
    EXPECT_NE(refusal_of_file(std::string("scene.background = [0, 0, ") + value + "]"), "accepted");
    EXPECT_NE(refusal_of_setting(std::string("light.intensity=") + value), "accepted");
  }
}

TEST_F(ReadConfig, WrongTypesAndUnitsAreRefused) {
  EXPECT_EQ(refusal_of_file("image = 3\n"),
            "run.toml:1: unknown key 'image'; `sheaf config` lists all keys");
  EXPECT_EQ(refusal_of_file("[image.width]\nx = 1\n"),
            "run.toml:1: image.width: expected a whole number of 1 to 16384 pixels, got a table");
  EXPECT_EQ(refusal_of_file("image.width = 1979-05-27\n"),
            "run.toml:1: image.width: expected a whole number of 1 to 16384 pixels, got a date or "
            "time");
  EXPECT_EQ(refusal_of_file("camera.position = [1, \"2\", 3]\n"),
            "run.toml:1: camera.position: expected three numbers [x, y, z] or \"off\", got an "
            "array of other things than numbers");
  EXPECT_EQ(refusal_of_setting("clock.frequency=1Ghz"),
            "--set clock.frequency=1Ghz: clock.frequency: expected a frequency such as \"1.5GHz\" "
            "or a number of hertz, got \"1Ghz\"");
}

TEST_F(ReadConfig, ImpossibleCombinationsAreRefused) {
  EXPECT_EQ(refusal_of_setting("l2.banks=3"), "l2.banks = 3 must be a power of two");
}

TEST_F(ReadConfig, SyntaxErrorsTellTheLine) {
  EXPECT_EQ(refusal_of_file("[image]\nwidth 5\n").substr(0, 22), "run.toml:2: not TOML: ");
  EXPECT_EQ(refusal_of_file("a = 1\na = 2\n").substr(0, 22), "run.toml:2: not TOML: ");
  EXPECT_EQ(refusal_of_file("image.width = 5 \xff\n").substr(0, 11), "run.toml:1:");
}

TEST_F(ReadConfig, AFileThatCannotBeReadIsTold) {
  fs::create_directory("folder");
  EXPECT_EQ(refusal([] { return resolve_config("none.toml", {}); }),
            "none.toml: cannot read this configuration file");
  EXPECT_EQ(refusal([] { return resolve_config("folder", {}); }),
            "folder: cannot read this configuration file");
}

TEST_F(ReadConfig, AnEmptyFileIsTheDefaults) {
  EXPECT_EQ(config_hash(read("")), config_hash(set({})));
}

TEST_F(ReadConfig, MalformedSettingsAreRefused) {
  EXPECT_EQ(refusal_of_setting("image.width"), "--set image.width: expected key=value");
  EXPECT_NE(refusal_of_setting("image.width=1\nimage.height=2"), "accepted");
  EXPECT_NE(refusal_of_setting("image.width="), "accepted");
  EXPECT_EQ(refusal_of_setting("camera.name=\xff"), "--set camera.name=\xff: not valid UTF-8");
  EXPECT_NE(refusal_of_setting(""), "accepted");
}

TEST_F(ReadConfig, HugeFilesAreRefused) {
  EXPECT_EQ(refusal_of_file(std::string((1 << 20) + 1, '#')),
            "run.toml: larger than 1MiB, which no configuration is");
}

TEST_F(ReadConfig, DeepNestingIsRefusedWithoutHarm) {
  std::string dots = "[a";
  for (int i = 0; i < 500'000; ++i) dots += ".a";
  EXPECT_EQ(refusal_of_file(dots + "]\n"), "run.toml:1: too many dots in one line");
  EXPECT_NE(refusal_of_file("a = " + std::string(100'000, '[')), "accepted");

  // The deepest that the limits on dots and on nested values let through together.
  std::string mixed;
  for (int i = 0; i < 1000; ++i) mixed += "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = [\n{";
  EXPECT_NE(refusal_of_file(mixed), "accepted");
  EXPECT_NE(refusal_of_setting("camera.name={" + dots.substr(1) + "=1}"), "accepted");
}

TEST_F(ReadConfig, CommentsMayHoldDots) {
  EXPECT_EQ(read("# " + std::string(100, '.') + "\nimage.width = 5\n").image.width, 5U);
}

TEST_F(ReadConfig, RandomBytesAndMutationsNeverGetThrough) {
  Random random(3);
  const std::string good = config_toml(set({}), Comments::kMeanings);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    for (std::uint64_t n = random.below(8) + 1; n > 0; --n) {
      bad[random.below(bad.size())] = static_cast<char>(random.below(256));
    }
    // Accepted or refused in one line; anything else ends the test.
    static_cast<void>(refusal_of_file(bad));
  }
}

}  // namespace
}  // namespace sheaf
