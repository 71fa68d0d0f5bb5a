// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace arete {

/// The options of a command that most people need, which --help shows first and alone; --help-all shows all.
///
/// @param command its words, "mesh info".
/// @return Long names, "--output". Empty: the command has few options, and --help shows all.
std::span<const std::string_view> commonOptions(std::string_view command);

/// The commands that have some, for tests.
std::span<const std::string_view> commandsWithCommonOptions();

}  // namespace arete
