// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace arete {

/// What is the matter with numbers that stand apart behind an option that takes them with commas between, as
/// in
/// "--from 390000 3800000 30".
///
/// @param app the program; words name its commands.
/// @param words of the command line, behind the program's name.
/// @return a sentence with the words as they have to be; empty where no numbers stand so.
std::string spacedNumbers(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace arete
