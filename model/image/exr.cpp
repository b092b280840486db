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

#include "image/file_output.h"

namespace sheaf {
namespace {

/// What OpenEXR writes, kept in memory.
class MemoryStream final : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}

  void write(const char data[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    bytes_.resize(std::max(bytes_.size(), position_ + count));
    std::copy_n(data, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ += count;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t position_ = 0;
};

}  // namespace

std::vector<std::uint8_t> encode_exr(std::uint32_t width, std::uint32_t height,
                                     std::span<const ExrChannel> channels,
                                     std::span<const ExrAttribute> attributes) {
  Imf::Header header(static_cast<int>(width), static_cast<int>(height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrAttribute& attribute : attributes) {
    header.insert(attribute.name, Imf::StringAttribute(attribute.value));
  }
  Imf::FrameBuffer frame;
  for (const ExrChannel& channel : channels) {
    if (channel.pixels.size() != std::size_t{width} * height) {
      throw std::logic_error("exr: channel " + channel.name + " is not of the image's size");
    }
    if (header.channels().findChannel(channel.name) != nullptr) {
      throw std::logic_error("exr: channel " + channel.name + " is there twice");
    }
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    // OpenEXR takes no pointer to const, though it only reads.
    auto* base = reinterpret_cast<char*>(const_cast<float*>(channel.pixels.data()));
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * std::size_t{width}));
  }
  MemoryStream stream;
  {
    constexpr int kNoThreads = 0;
    Imf::OutputFile file(stream, header, kNoThreads);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(height));
  }
  return stream.take();
}

void write_exr(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const ExrChannel> channels, std::span<const ExrAttribute> attributes) {
  write_file(path, encode_exr(width, height, channels, attributes));
}

}  // namespace sheaf
