// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/errors.h"
#include "base/random.h"
#include "rows_of.h"

namespace sheaf {
namespace {

constexpr std::uint32_t kWidth = 37;
constexpr std::uint32_t kHeight = 41;

std::vector<float> noise(std::uint64_t seed) {
  Random random(seed);
  std::vector<float> pixels(kWidth * kHeight);
  for (float& pixel : pixels) {
    pixel = random.uniform() * 100.0F;
  }
  return pixels;
}

std::vector<float> read_channel(Imf::InputFile& file, const std::string& name) {
  std::vector<float> pixels(kWidth * kHeight);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), sizeof(float),
                                sizeof(float) * kWidth));
  file.setFrameBuffer(frame);
  file.readPixels(0, static_cast<int>(kHeight) - 1);
  return pixels;
}

/// What write_exr() leaves in a file.
std::vector<char> encode_exr(std::uint32_t width, std::uint32_t height,
                             std::span<const ExrChannel> channels,
                             std::span<const ExrAttribute> attributes) {
  const auto path = std::filesystem::path(testing::TempDir()) / "sheaf_exr_bytes.exr";
  write_exr(path, width, height, channels, attributes);
  std::ifstream file(path, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return bytes;
}

std::string string_attribute(const Imf::InputFile& file, const char* name) {
  return file.header().typedAttribute<Imf::StringAttribute>(name).value();
}

TEST(Exr, GivesBackChannelsAndAttributesBitForBit) {
  auto red = noise(1);
  red[0] = std::numeric_limits<float>::denorm_min();
  red[1] = std::numeric_limits<float>::infinity();
  red[2] = -0.0F;
  const auto depth = noise(2);
  const auto heat = noise(3);
  const ExrChannel channels[] = {{"R", rows_of<float>(red)},
                                 {"depth.Z", rows_of<float>(depth)},
                                 {"heat.node_visits.Y", rows_of<float>(heat)}};
  const std::vector<float>* const written[] = {&red, &depth, &heat};
  const ExrAttribute attributes[] = {{"sheaf.config", "0123abcd"}, {"sheaf.version", "0.1.0"}};
  const auto path = std::filesystem::path(testing::TempDir()) / "sheaf_exr_round_trip.exr";
  write_exr(path, kWidth, kHeight, channels, attributes);
  {
    Imf::InputFile file(path.c_str());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(string_attribute(file, "sheaf.config"), "0123abcd");
    EXPECT_EQ(string_attribute(file, "sheaf.version"), "0.1.0");
    for (std::size_t c = 0; c < 3; ++c) {
      const ExrChannel& channel = channels[c];
      const Imf::Channel* found = file.header().channels().findChannel(channel.name);
      ASSERT_NE(found, nullptr) << channel.name;
      EXPECT_EQ(found->type, Imf::FLOAT);
      const auto read = read_channel(file, channel.name);
      for (std::size_t i = 0; i < read.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(read[i]),
                  std::bit_cast<std::uint32_t>((*written[c])[i]))
            << channel.name << " pixel " << i;
      }
    }
  }
  std::filesystem::remove(path);
}

TEST(Exr, HasTheSameBytesWhateverTheThreadsAndTheOrderOfChannels) {
  const auto a = noise(1);
  const auto b = noise(2);
  const ExrAttribute attributes[] = {{"sheaf.version", "0.1.0"}};
  const ExrChannel channels[] = {{"R", rows_of<float>(a)}, {"G", rows_of<float>(b)}};
  const ExrChannel swapped[] = {{"G", rows_of<float>(b)}, {"R", rows_of<float>(a)}};
  const auto bytes = encode_exr(kWidth, kHeight, channels, attributes);
  EXPECT_EQ(encode_exr(kWidth, kHeight, swapped, attributes), bytes);
  Imf::setGlobalThreadCount(3);
  EXPECT_EQ(encode_exr(kWidth, kHeight, channels, attributes), bytes);
}

TEST(Exr, RefusesChannelsThatDoNotFit) {
  const auto pixels = noise(1);
  const ExrChannel channel[] = {{"R", rows_of<float>(pixels)}};
  EXPECT_THROW(encode_exr(kWidth, kHeight + 1, channel, {}), std::logic_error);
  EXPECT_FALSE(
      std::filesystem::exists(std::filesystem::path(testing::TempDir()) / "sheaf_exr_bytes.exr"));
  const ExrChannel twice[] = {{"R", rows_of<float>(pixels)}, {"R", rows_of<float>(pixels)}};
  EXPECT_THROW(encode_exr(kWidth, kHeight, twice, {}), std::logic_error);
}

TEST(Exr, SaysWhichFileCannotBeWritten) {
  const auto pixels = noise(1);
  const ExrChannel channel[] = {{"R", rows_of<float>(pixels)}};
  const auto path = std::filesystem::path(testing::TempDir()) / "no_such_folder" / "image.exr";
  try {
    write_exr(path, kWidth, kHeight, channel, {});
    FAIL() << "written into a folder that does not exist";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_EQ(std::string(error.what()).rfind(path.string() + ": ", 0), 0U) << error.what();
  }
}

}  // namespace
}  // namespace sheaf
