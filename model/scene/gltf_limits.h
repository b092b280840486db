// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// How much a scene file may ask for, so that a small file cannot claim a big machine's memory.
namespace sheaf::gltf {

/// Scene file, and all that it names together. A GLB states its length in 32 bits.
inline constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32;
/// JSON text. Larger scenes keep their data in buffers outside of the JSON.
inline constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{1} << 28;
/// Nested objects and arrays; the deepest that this loader reads is about ten.
inline constexpr int kMaxJsonDepth = 64;
/// Nodes, meshes, accessors and the like, each.
inline constexpr std::uint64_t kMaxEntries = std::uint64_t{1} << 20;
/// Triangles after instancing; a flat-shaded one takes 90 bytes.
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 26;
/// Elements of an accessor without a buffer view, which a file gets for nothing.
inline constexpr std::uint64_t kMaxZeroElements = std::uint64_t{1} << 24;
/// Either side of an image, in pixels.
inline constexpr std::uint32_t kMaxImageSide = 16384;
/// Texels of all images together, 4 bytes each.
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 28;
/// Scans of a JPEG, for each of these texels on average. Each scan visits every texel, which ten
/// bytes of a file get for nothing; progressive files have about ten.
inline constexpr std::uint64_t kMaxScansPerTexel = 16;

}  // namespace sheaf::gltf
