// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/manual/declarations.h"

namespace arete {

/// A script that makes bash complete commands, options and the words that an option takes; file names
/// elsewhere. zsh takes it too, after `autoload bashcompinit; bashcompinit`.
std::string bashCompletion(const CLI::App& program);

}  // namespace arete
