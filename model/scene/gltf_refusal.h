// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sheaf::gltf {

/// Why a scene file is refused: "place: what is wrong; remedy". load_scene adds the file's name.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `place` is a JSON pointer into the file such as "/accessors/3", or empty for the whole file.
[[noreturn]] void refuse(std::string_view place, std::string_view what);

/// Most bytes of text from a file in a message.
constexpr std::size_t kLongestMessage = 400;

/// Collects warnings; the same one again is counted, not repeated.
class Warnings {
 public:
  void add(std::string_view text);
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  struct Entry {
    std::string text;
    int times;
  };
  std::vector<Entry> entries_;
};

}  // namespace sheaf::gltf
