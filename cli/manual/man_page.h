// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/manual/declarations.h"

namespace arete {

/// The name of a command's page without its section: "arete-mesh-info".
std::string pageName(const DeclaredCommand& command);

/// A manual page of section 1, in the man macros: name, synopsis, arguments, options by group, examples, exit
/// codes, and the pages beside it.
std::string manPage(const DeclaredCommand& command, const CLI::App& program);

}  // namespace arete
