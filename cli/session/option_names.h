// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

// The library names fields ("maxTriangles"); a user of the command line knows options ("--max-triangles").
// This is the only place that translates one into the other.

/// @param field a field of an options struct of the library, as an error's culprit names it ("rimTolerance").
/// @return the option that sets it ("--rim-tolerance"), or nothing where no option does.
std::optional<std::string_view> optionOfField(std::string_view field);

/// Translates a sentence of the library: each field in backquotes becomes its option.
///
/// @param sentence "state it with `crs`" becomes "state it with --crs". Backquotes around anything else stay.
std::string withOptionNames(std::string_view sentence);

/// Translates an error of the library.
///
/// If the culprit is a field, or a field and its value ("region 1,2,3,4"), the field becomes its option. The
/// culprit of an error about a file (notFound, unreadable, corrupt) is kept, even if the file has the name of
/// a field. The sentence is translated by withOptionNames().
Error withOptionNames(Error error);

}  // namespace arete
