// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/gltf_refusal.h"
#include "scene/gltf_uri.h"

namespace sheaf::gltf {

/// An image as the file names it: not read yet, because most files have some that nobody needs.
struct ImageSource {
  std::string uri;  ///< empty: in a buffer view
  int buffer_view = -1;
};

/// An opened scene file. tinygltf parses the JSON; it is kept away from buffers and images, which
/// it would read without the checks that hostile files need, and copy.
struct Document {
  explicit Document(const std::filesystem::path& file) : uris(file) {}

  tinygltf::Model model;          ///< without buffers and images
  std::vector<ByteView> buffers;  ///< each byteLength long
  std::vector<ImageSource> images;
  UriReader uris;
  Warnings warnings;

  Bytes8 file_bytes;          ///< what a GLB's buffer lies in
  std::vector<Bytes8> owned;  ///< what the other buffers lie in
};

[[nodiscard]] Document open_document(const std::filesystem::path& path);

/// The bytes of buffer view `index`, which `place` refers to.
[[nodiscard]] ByteView buffer_view_bytes(const Document& document, const std::string& place,
                                         int index);

}  // namespace sheaf::gltf
