// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "memory/dram/text_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "config/config_text.h"

namespace sheaf {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;
constexpr std::size_t kLongestLine = 256;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view next_word(std::string_view& line) {
  const auto begin = std::find_if_not(line.begin(), line.end(), is_blank);
  const auto end = std::find_if(begin, line.end(), is_blank);
  line = {end, line.end()};
  return {begin, end};
}

template <typename Number>
std::optional<Number> parse_number(std::string_view digits, int base) {
  Number number{};
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    return (x >= 'a' && x <= 'z' ? static_cast<char>(x - 'a' + 'A') : x) == y;
  });
}

std::optional<bool> parse_write(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, bool>, 6> kCommands{{{"READ", false},
                                                                               {"WRITE", true},
                                                                               {"P_FETCH", false},
                                                                               {"P_MEM_RD", false},
                                                                               {"P_MEM_WR", true},
                                                                               {"BOFF", true}}};
  for (const auto& [name, write] : kCommands) {
    if (same_word(word, name)) return write;
  }
  return std::nullopt;
}

}  // namespace

void TextTrace::Close::operator()(std::FILE* file) const {
  if (file != stdin) std::fclose(file);
}

TextTrace::TextTrace(const std::string& path)
    : name_(path == "-" ? "standard input" : path),
      file_(path == "-" ? stdin : std::fopen(path.c_str(), "rb")),
      buffer_(kBufferSize) {
  if (!file_) {
    throw Error(ExitCode::kTrace,
                fmt::format("{}: cannot be read: {}", printable(name_), std::strerror(errno)));
  }
}

void TextTrace::refuse(const std::string& what) const {
  throw Error(ExitCode::kTrace, fmt::format("{}:{}: {}", printable(name_), line_, what));
}

bool TextTrace::next_line(std::string_view& line) {
  for (;;) {
    const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto last = buffer_.begin() + static_cast<std::ptrdiff_t>(end_);
    const auto newline = std::find(first, last, '\n');
    const auto length = static_cast<std::size_t>(newline - first);
    if (newline != last || (at_end_ && length != 0)) {
      ++line_;
      if (length > kLongestLine) refuse("line too long to be an access");
      line = std::string_view(buffer_.data() + begin_, length);
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      begin_ += length + (newline != last ? 1 : 0);
      return true;
    }
    if (at_end_) return false;
    if (length > kLongestLine) {
      ++line_;
      refuse("line too long to be an access");
    }
    std::copy(first, last, buffer_.begin());
    begin_ = 0;
    end_ = length;
    const std::size_t got =
        std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
    if (std::ferror(file_.get()) != 0) {
      throw Error(ExitCode::kTrace,
                  fmt::format("{}: cannot be read: {}", printable(name_), std::strerror(errno)));
    }
    end_ += got;
    at_end_ = got == 0;
  }
}

void TextTrace::parse(std::string_view line, TraceAccess& access) const {
  std::string_view address = next_word(line);
  const std::string_view command = next_word(line);
  const std::string_view arrival = next_word(line);
  if (arrival.empty() || !next_word(line).empty()) {
    refuse("should be an address, READ or WRITE, and an arrival, as in '0x2000D5C0 READ 30'");
  }
  const std::string_view shown = address;
  if (address.starts_with("0x") || address.starts_with("0X")) address.remove_prefix(2);
  const auto number = parse_number<Address>(address, 16);
  if (!number) refuse(fmt::format("'{}' is no hexadecimal address", printable(shown)));
  const auto write = parse_write(command);
  if (!write) refuse(fmt::format("'{}' is neither READ nor WRITE", printable(command)));
  const auto time = parse_number<Cycles>(arrival, 10);
  if (!time || *time > kLastArrival) {
    refuse(fmt::format("'{}' is no arrival in memory cycles (0 to 2^52)", printable(arrival)));
  }
  if (*time < last_arrival_) {
    refuse(fmt::format("arrival {} is before the last one, {}; sort the trace by arrival", *time,
                       last_arrival_));
  }
  access = {*number, *write, *time};
}

bool TextTrace::next(TraceAccess& access) {
  std::string_view line;
  while (next_line(line)) {
    const auto first = std::find_if_not(line.begin(), line.end(), is_blank);
    if (first == line.end() || *first == '#') continue;
    parse(line, access);
    last_arrival_ = access.arrival;
    return true;
  }
  return false;
}

}  // namespace sheaf
