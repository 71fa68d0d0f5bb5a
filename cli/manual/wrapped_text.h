// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace arete {

/// The columns of the terminal: $COLUMNS, else what the terminal of stdout or stderr says, else 80; at least
/// 40, and at most 120, beyond which lines are hard to read.
std::size_t terminalColumns();

/// Text in lines of at most `columns` columns, each with its end. Words are parted at blanks and line ends;
/// one that is longer than a line is broken, behind punctuation where it has any.
///
/// @param first columns that are filled already in the first line, which has no indentation.
/// @param indent of the lines behind the first.
/// Precondition: indent < columns.
std::string wrapped(std::string_view text, std::size_t columns, std::size_t first, std::size_t indent);

/// A command of a shell, in lines of at most `columns` columns where its words permit that: each line but the
/// last ends in " \", so that all can be pasted. What stands behind it after three blanks is a comment,
/// and gets a line of its own where it does not fit.
///
/// @param line "  arete info dem.amt     what is in it", with its indentation.
std::string wrappedCommand(std::string_view line, std::size_t columns);

}  // namespace arete
