// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace arete {

/// Whether pictures show a text as it is written: their font (DejaVu Sans) has Latin, Greek, Cyrillic,
/// Armenian and Georgian letters, and symbols. It lacks the scripts of India and East Asia, and letters that
/// run from the right or change their shape, as in Arabic, are not set as they should be. O(length).
///
/// Precondition: UTF-8.
bool isDrawnAsWritten(std::string_view utf8);

}  // namespace arete
