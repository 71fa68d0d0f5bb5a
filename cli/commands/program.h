// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/session/exit_code.h"
#include "cli/session/session.h"

namespace arete {

/// Declares every command with its options.
void declareProgram(CLI::App& app, Session& session);

/// Parses the command line, runs its command and returns the exit code of the process. Exceptions of
/// the standard library pass through; main() reports them.
ExitCode runProgram(int argc, char** argv);

}  // namespace arete
