// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/help_formatter.h"

#include <sstream>

#include "base/text.h"

namespace sheaf {
namespace {

constexpr std::size_t kLeftColumn = 30;

std::string two_columns(const std::string& left, const std::string& right) {
  const std::string name = "  " + left;
  std::string text = wrapped(right, std::string(kLeftColumn, ' '));
  if (name.size() < kLeftColumn && !text.empty()) return text.replace(0, name.size(), name);
  return name + "\n" + text;
}

/// The name of an option's type, or the choices that a validator leaves: CLI11 joins them by ':'.
std::string type_of(const CLI::Option& option) {
  const std::string all = option.get_type_name();
  const std::size_t colon = all.find(':');
  return colon == 0 ? all.substr(1) : all.substr(0, colon);
}

}  // namespace

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string name = make_option_name(option, is_positional);
  return two_columns(is_positional ? name : name + make_option_opts(option),
                     make_option_desc(option));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0) return "";
  const std::string& value = option->get_default_str();
  return " " + type_of(*option) + (value.empty() ? "" : "=" + value);
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  for (const CLI::Option* needed : option->get_needs()) {
    text += " (with " + needed->get_name() + ")";
  }
  return text;
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::istringstream lines(app->get_footer());
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    text += line.empty() || line.front() == ' ' ? line + "\n" : wrapped(line, "");
  }
  return text;
}

}  // namespace sheaf
