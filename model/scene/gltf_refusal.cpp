// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_refusal.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace sheaf::gltf {

void refuse(std::string_view place, std::string_view what) {
  throw Refusal(place.empty() ? std::string(what) : fmt::format("{}: {}", place, what));
}

void Warnings::add(std::string_view text) {
  const auto same = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const Entry& e) { return e.text == text; });
  if (same != entries_.end()) {
    ++same->times;
  } else {
    entries_.push_back({std::string(text), 1});
  }
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> lines;
  lines.reserve(entries_.size());
  for (const Entry& e : entries_) {
    const std::string line = printable(e.text, kLongestMessage);
    lines.push_back(e.times == 1 ? line : fmt::format("{} ({} times)", line, e.times));
  }
  return lines;
}

}  // namespace sheaf::gltf
