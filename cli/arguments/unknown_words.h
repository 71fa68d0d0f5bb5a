// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace arete {

// Sentences for words of a command line that the parser does not know, with what was perhaps meant. CLI11
// lists the words that are left over, the values of an unknown option among them.

/// A sentence for the first word where a command of `app`, or of one of its commands, should be named and is
/// not. Empty: there is no such word.
std::string unknownCommand(const CLI::App& app, const std::vector<std::string>& words);

/// A sentence for the first word that looks like an option and is not one of `command`, with the options of
/// similar names. Empty: there is no such word.
std::string unknownOption(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace arete
