// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/query/extract/tin.h"

namespace arete {

/// What `arete extract` prints of a TIN that it wrote.
/// @param unit of heights; empty: not known
std::string extractText(const ExtractRequest& request, const ExtractedTin& tin, const std::string& unit);

}  // namespace arete
