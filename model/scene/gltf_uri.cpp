// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_uri.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <system_error>

#include "base/text.h"
#include "scene/gltf_limits.h"
#include "scene/gltf_refusal.h"

namespace sheaf::gltf {
namespace {

namespace fs = std::filesystem;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// RFC 3986, section 2.1. A '%' that does not begin an escape stands for itself.
std::string percent_decoded(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() && uri[i] == '%' ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low >= 0) {
      result += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

bool has_scheme(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string::npos && uri.find('/') > colon;
}

Bytes8 decode_data(const std::string& place, const std::string& uri) {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  if (mark == std::string::npos) refuse(place, "a data URI without base64 is not supported");
  // The media type is the reader's business; tinygltf knows only a few.
  const std::string known = "data:application/octet-stream;base64,";
  Bytes8 bytes;
  std::string type;
  if (!tinygltf::DecodeDataURI(&bytes, type, known + uri.substr(mark + kMark.size()), 0, false)) {
    refuse(place, "the data URI holds no base64 data");
  }
  return bytes;
}

}  // namespace

UriReader::UriReader(const fs::path& scene_file) : remaining_(kMaxBytes) {
  const fs::path parent = scene_file.parent_path();
  folder_ = fs::canonical(parent.empty() ? fs::path(".") : parent);
}

fs::path UriReader::resolve(const std::string& place, const std::string& uri) const {
  const std::string shown = printable(uri, 80);
  const std::string name = percent_decoded(uri);
  if (has_scheme(uri)) {
    refuse(place, fmt::format("\"{}\" is not a file; only files beside the scene are read", shown));
  }
  if (name.empty() || name.find('\0') != std::string::npos) {
    refuse(place, fmt::format("\"{}\" is not a file name", shown));
  }
  const fs::path relative(name);
  const bool climbs = std::any_of(relative.begin(), relative.end(),
                                  [](const fs::path& part) { return part == ".."; });
  if (relative.is_absolute() || climbs || name.find('\\') != std::string::npos) {
    refuse(place, fmt::format("\"{}\" leads out of the scene's folder; put the file beside the "
                              "scene",
                              shown));
  }
  std::error_code error;
  fs::path target = fs::weakly_canonical(folder_ / relative, error);
  const auto [end, unused] =
      std::mismatch(folder_.begin(), folder_.end(), target.begin(), target.end());
  if (error || end != folder_.end()) {
    refuse(place, fmt::format("\"{}\" leads out of the scene's folder through a link; put the file "
                              "beside the scene",
                              shown));
  }
  return target;
}

void UriReader::check(const std::string& place, const std::string& uri) const {
  if (!uri.starts_with("data:")) (void)resolve(place, uri);
}

Bytes8 UriReader::read(const std::string& place, const std::string& uri) {
  Bytes8 bytes;
  if (uri.starts_with("data:")) {
    bytes = decode_data(place, uri);
  } else {
    fs::path target = resolve(place, uri);
    try {
      bytes = read_file(target, remaining_);
    } catch (const Refusal& refusal) {
      refuse(place, fmt::format("\"{}\": {}", printable(uri, 80), refusal.what()));
    }
  }
  if (bytes.size() > remaining_) refuse(place, "the scene's data exceed the limit of 4 GiB");
  remaining_ -= bytes.size();
  return bytes;
}

}  // namespace sheaf::gltf
