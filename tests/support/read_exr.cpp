// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/read_exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

namespace sheaf::test {

ExrImage read_exr(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  ExrImage image;
  image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  Imf::FrameBuffer frame;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    std::vector<float>& pixels = image.channels[channel.name()];
    pixels.resize(std::size_t{image.width} * image.height);
    frame.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()),
                                            sizeof(float), sizeof(float) * image.width));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text != nullptr) image.texts[attribute.name()] = text->value();
  }
  return image;
}

}  // namespace sheaf::test
