// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sheaf {

/// Lays out `--help` so that every line fits the line width. Options take a type name, or the
/// choices there are, and a default; what they need stands behind their meaning. A footer's lines
/// are paragraphs, those that begin with a blank are kept as they are.
class HelpFormatter final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override;
  [[nodiscard]] std::string make_option(const CLI::Option* option,
                                        bool is_positional) const override;
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_footer(const CLI::App* app) const override;
};

}  // namespace sheaf
