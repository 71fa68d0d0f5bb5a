// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace arete {

/// A command with the words that lead to it: {"mesh", "info"}; the program itself has none.
struct DeclaredCommand {
  std::vector<std::string> words;
  const CLI::App* app = nullptr;

  /// Its words with something between them.
  std::string joined(std::string_view between) const;
};

/// The program, its commands and theirs, in the order of their declaration.
std::vector<DeclaredCommand> declaredCommands(const CLI::App& program);

/// An option as a person writes it.
struct DeclaredOption {
  std::vector<std::string> names;    ///< "-o", "--output"; of an argument its name alone
  std::string value;                 ///< "FILE"; empty: a flag
  std::vector<std::string> choices;  ///< where the value is one of some words
  std::string text, group;
  std::vector<std::string> constraints;  ///< "with --camera only", "not with --region", "from 1 to 8"
  bool isArgument = false, isRequired = false;

  /// The text, with what constrains the option behind it.
  std::string textWithConstraints() const;
};
std::vector<DeclaredOption> declaredOptions(const CLI::App& app);

}  // namespace arete
