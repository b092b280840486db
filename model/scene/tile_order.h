// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace sheaf {

/// The order in which primary packets are made: square tiles row by row, and within a tile runs of
/// `run` pixels along the Z-order curve of the smallest power-of-two square around it. Runs whose
/// length is a power of four are square blocks (4 × 4 for 16). Pixels outside the tile or the
/// picture leave their lane empty; runs without any pixel are skipped. All tiles are visited, or a
/// choice of them.
class TileOrder {
 public:
  static constexpr int kMaxRun = 64;
  static constexpr std::uint32_t kNoPixel = ~std::uint32_t{0};

  /// `choice`: numbers of the tiles to be visited, in order; empty: all.
  TileOrder(std::uint32_t width, std::uint32_t height, std::uint32_t tile, int run,
            std::vector<std::uint32_t> choice = {})
      : width_(width), height_(height), tile_(tile), run_(run), choice_(std::move(choice)) {}

  // Filled as far as it is read.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  struct Run {
    std::array<std::uint32_t, kMaxRun> pixels;  ///< row × width + column, or kNoPixel
    std::uint32_t tile = 0;                     ///< number of the tile, row by row
  };

  /// The next run of the current tile; false once the tile has no more.
  bool next_run(Run& run) {
    const std::uint64_t side = std::bit_ceil(tile_);
    const std::uint64_t codes = side * side;
    while (code_ < codes && !is_done()) {
      bool any = false;
      for (int lane = 0; lane < run_; ++lane) {
        const std::uint32_t pixel = code_ < codes ? pixel_of(code_) : kNoPixel;
        ++code_;
        run.pixels[static_cast<std::size_t>(lane)] = pixel;
        any |= pixel != kNoPixel;
      }
      if (any) {
        run.tile = tile();
        return true;
      }
    }
    return false;
  }

  /// Goes on to the next tile; is_done() if there is none.
  void next_tile() {
    ++num_visited_;
    code_ = 0;
  }
  [[nodiscard]] bool is_done() const { return num_visited_ >= num_tiles(); }
  [[nodiscard]] bool is_last() const { return num_visited_ + 1 == num_tiles(); }
  /// Tiles to be visited.
  [[nodiscard]] std::uint32_t num_tiles() const {
    return choice_.empty() ? tiles_across() * tiles_down()
                           : static_cast<std::uint32_t>(choice_.size());
  }
  /// Of these, those before the current one.
  [[nodiscard]] std::uint32_t num_visited() const { return num_visited_; }
  /// The current tile's number in the picture, row by row.
  [[nodiscard]] std::uint32_t tile() const {
    return choice_.empty() ? num_visited_ : choice_[num_visited_];
  }

 private:
  [[nodiscard]] std::uint32_t tiles_across() const { return (width_ + tile_ - 1) / tile_; }
  [[nodiscard]] std::uint32_t tiles_down() const { return (height_ + tile_ - 1) / tile_; }

  /// Every second bit of a Z-order code, beginning with bit 0.
  [[nodiscard]] static std::uint32_t even_bits(std::uint64_t code) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 32; ++i) bits |= static_cast<std::uint32_t>(code >> (2 * i) & 1U) << i;
    return bits;
  }
  [[nodiscard]] std::uint32_t pixel_of(std::uint64_t code) const {
    const std::uint32_t in_x = even_bits(code);
    const std::uint32_t in_y = even_bits(code >> 1);
    if (in_x >= tile_ || in_y >= tile_) return kNoPixel;
    const std::uint32_t x = tile() % tiles_across() * tile_ + in_x;
    const std::uint32_t y = tile() / tiles_across() * tile_ + in_y;
    return x < width_ && y < height_ ? y * width_ + x : kNoPixel;
  }

  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t tile_;
  int run_;
  std::vector<std::uint32_t> choice_;
  std::uint32_t num_visited_ = 0;
  std::uint64_t code_ = 0;
};

}  // namespace sheaf
