// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Options that several commands take, each with the same name, type and meaning.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sheaf {

template <typename Options>
void declare_scene(CLI::App& command, Options& options) {
  command.add_option("SCENE", options.scene, "glTF 2.0 file (.gltf or .glb)")->required();
}

template <typename Options>
void declare_trace(CLI::App& command, Options& options) {
  command.add_option("TRACE", options.trace, "Trace that 'sheaf run --record' wrote")->required();
}

template <typename Options>
void declare_machine(CLI::App& command, Options& options) {
  command.add_option("--config", options.config, "TOML file with parameters of the machine")
      ->type_name("FILE");
  command
      .add_option("--set", options.settings,
                  "Set one parameter, for example --set ray_cache.heuristic=mdir(96); repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

template <typename Options>
void declare_cache(CLI::App& command, Options& options) {
  command
      .add_option("--cache", options.cache,
                  "Folder in which kd-trees are kept from run to run, or none (default sheaf in "
                  "$XDG_CACHE_HOME or ~/.cache; at most 1 GiB)")
      ->type_name("DIR");
}

template <typename Options>
void declare_out(CLI::App& command, Options& options, const std::string& folder) {
  command.add_option("--out", options.out, "Folder for the results (default " + folder + ")")
      ->type_name("DIR");
}

template <typename Options>
void declare_parent(CLI::App& command, Options& options) {
  command
      .add_option("--parent", options.parent,
                  "End with the process of this number, which must have started this one")
      ->type_name("N");
}

/// The name of one of several choices, which are pairs of a name and a value.
template <typename Choices, typename Value>
[[nodiscard]] std::string name_of(const Choices& choices, Value value) {
  return std::ranges::find(choices, value, [](const auto& choice) { return choice.second; })->first;
}

/// An option that takes one of the names; `chosen` becomes what it stands for.
template <typename Choices, typename Chosen>
CLI::Option* add_choice(CLI::App& command, const std::string& option, const Choices& choices,
                        Chosen& chosen, const std::string& meaning) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.emplace_back(name);
  const auto choose = [&choices, &chosen](const std::string& given) {
    chosen = std::ranges::find(choices, given, [](const auto& choice) {
               return std::string(choice.first);
             })->second;
  };
  return command.add_option_function<std::string>(option, choose, meaning)
      ->type_name("")
      ->check(CLI::IsMember(names));
}

}  // namespace sheaf
