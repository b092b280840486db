// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/usage_problem.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "base/text.h"

namespace sheaf {
namespace {

/// "sheaf run", without the name under which the program was started.
std::string command_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? "sheaf"
                                     : command_of(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string remedy(const CLI::App& app, const std::string& word,
                   const std::vector<std::string>& known) {
  const auto letters = [](std::string_view name) {
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
  };
  const std::string_view typed = letters(word);
  const auto distance = [&](const std::string& name) {
    return edit_distance(typed, letters(name));
  };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (nearest != known.end() && may_be_meant(typed, distance(*nearest))) {
    return fmt::format("did you mean '{}'?", *nearest);
  }
  return fmt::format("`{} --help` lists what there is", command_of(app));
}

std::string unknown_word(const CLI::App& app, const std::string& given) {
  const std::string word = given.substr(0, given.find('='));
  if (word.starts_with('-')) {
    return fmt::format("unknown option '{}'; {}", printable(word),
                       remedy(app, word, option_names(app)));
  }
  const std::vector<std::string> commands = command_names(app);
  if (commands.empty()) {
    return fmt::format("'{}' is one argument too many; {}", printable(given), remedy(app, {}, {}));
  }
  return fmt::format("unknown command '{}'; {}", printable(word), remedy(app, word, commands));
}

}  // namespace

std::string usage_problem(const CLI::App& app, const CLI::ParseError& error) {
  // A word that nobody knows explains why something else is missing.
  const bool may_be_a_word = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                             dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  for (const CLI::App* command = &app;; command = command->get_subcommands().front()) {
    const std::vector<std::string> unknown = command->remaining();
    if (may_be_a_word && !unknown.empty()) return unknown_word(*command, unknown.front());
    if (command->get_subcommands().empty()) {
      if (!command_names(*command).empty()) {
        return fmt::format("a command is missing; {}", remedy(*command, {}, {}));
      }
      return fmt::format("{}; see `{} --help`", error.what(), command_of(*command));
    }
  }
}

}  // namespace sheaf
