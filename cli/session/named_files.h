// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/session/json.h"
#include "engine/base/result.h"

namespace arete {

/// Options of a command as they were typed, by their long names: a text, a list of texts, or true for a flag.
///
/// @param words the words of the command line, behind the program's name
Json typedOptions(const CLI::App& command, const std::vector<std::string>& words);

/// Whether an option of this long name ("--certificate") names what is written.
bool isOutputOption(const std::string& name);

/// The files that a parsed command line names as inputs: arguments and options whose values are files. A
/// folder and a pattern stand for the files in them, an archive's member for the archive, an address for
/// itself. What does not exist is left out, outputs too. Each file once, in the order of the options.
std::vector<std::string> namedInputs(const CLI::App& command);

/// Checks that a file is named by no other option of the command, under whatever name.
///
/// @param option the option that names the file
/// Errors: usage, naming both.
Status checkNamedOnce(const CLI::App& command, const std::string& option, const std::string& path);

}  // namespace arete
