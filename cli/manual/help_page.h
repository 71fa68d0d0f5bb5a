// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace arete {

/// What makes the pages of --help and --help-all, in lines of the terminal's width: --help has the common
/// options of a command (common_options.h), --help-all has all, of the program the pages of all commands.
std::shared_ptr<CLI::FormatterBase> helpPages();

}  // namespace arete
