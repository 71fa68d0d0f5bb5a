// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace arete {

/// Declares that the output of a command with one input may be its second argument, instead of --output:
/// `arete convert a.ply b.glb`. Only a name that ends in a format which the command writes is one, so that a
/// further input is never taken for the output. For commands whose only argument is one input, and which
/// declare --output, not as required: requireOneOutput() does that.
///
/// @param extensions ".ply"; in lower case.
void addOutputArgument(CLI::App& command, std::string& path, std::vector<std::string> extensions);

/// Whether the command has its output as an argument.
bool hasOutputArgument(const CLI::App& command);

/// Throws CLI::ParseError where a command with an output argument got no output, or one in both ways.
void requireOneOutput(const CLI::App& command);

}  // namespace arete
