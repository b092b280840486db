// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "image/file_output.h"

namespace sheaf {
namespace {

// The scan lines that ZIP compresses together.
constexpr std::uint32_t kBandLines = 16;

class ExrStream final : public Imf::OStream {
 public:
  ExrStream(FileOutput& output, const std::string& name)
      : Imf::OStream(name.c_str()), output_(output) {}

  void write(const char data[], int size) override {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(data);
    output_.write({bytes, static_cast<std::size_t>(size)});
  }
  std::uint64_t tellp() override { return output_.position(); }
  void seekp(std::uint64_t position) override { output_.seek(position); }

 private:
  FileOutput& output_;
};

Imf::Header make_header(std::uint32_t width, std::uint32_t height,
                        std::span<const ExrChannel> channels,
                        std::span<const ExrAttribute> attributes) {
  Imf::Header header(static_cast<int>(width), static_cast<int>(height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrAttribute& attribute : attributes) {
    header.insert(attribute.name, Imf::StringAttribute(attribute.value));
  }
  for (const ExrChannel& channel : channels) {
    if (header.channels().findChannel(channel.name) != nullptr) {
      throw std::logic_error("exr: channel " + channel.name + " is there twice");
    }
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  }
  return header;
}

/// A few rows of one channel.
class Band {
 public:
  explicit Band(std::uint32_t width) : width_(width), pixels_(std::size_t{width} * kBandLines) {}

  Imf::Slice fill(const RowSource<float>& rows, std::uint32_t first, std::uint32_t num_rows) {
    for (std::uint32_t i = 0; i < num_rows; ++i) {
      rows(first + i, std::span(pixels_).subspan(std::size_t{i} * width_, width_));
    }
    return Imf::Slice::Make(Imf::FLOAT, pixels_.data(), {0, static_cast<int>(first)},
                            static_cast<int>(width_), static_cast<int>(num_rows), sizeof(float),
                            sizeof(float) * width_);
  }

 private:
  std::size_t width_;
  std::vector<float> pixels_;
};

}  // namespace

void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const ExrChannel> channels, std::span<const ExrAttribute> attributes) {
  const Imf::Header header = make_header(width, height, channels, attributes);
  FileOutput output(path);
  ExrStream stream(output, path.string());
  std::vector<Band> bands(channels.size(), Band(width));
  {
    constexpr int kNoThreads = 0;
    Imf::OutputFile file(stream, header, kNoThreads);
    for (std::uint32_t y = 0; y < height; y += kBandLines) {
      const std::uint32_t num_rows = std::min(kBandLines, height - y);
      Imf::FrameBuffer frame;
      for (std::size_t i = 0; i < channels.size(); ++i) {
        frame.insert(channels[i].name, bands[i].fill(channels[i].rows, y, num_rows));
      }
      file.setFrameBuffer(frame);
      file.writePixels(static_cast<int>(num_rows));
    }
  }
  output.close();
}

}  // namespace sheaf
