// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/watch_window.h"

#include <charconv>

namespace sheaf {
namespace {

// Leaves `value` as it is if the text is empty. False if the text is no number.
bool read(std::string_view text, Cycles& value) {
  if (text.empty()) return true;
  const char* const last = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && rest == last;
}

}  // namespace

std::optional<WatchWindow> WatchWindow::parse(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return {};
  WatchWindow window;
  if (!read(text.substr(0, dots), window.begin)) return {};
  if (!read(text.substr(dots + 2), window.end)) return {};
  if (window.begin >= window.end) return {};
  return window;
}

}  // namespace sheaf
