// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "surface/model/attribute.h"

namespace arete {

/// Whether an attribute that no format gives a meaning is a label: a number that says which, not how much,
/// so that an average says nothing. Integers are labels, and so are floats that are all whole (NaN and
/// infinity aside), as formats without integers keep them, and those of which the name says so
/// (isNameOfLabels()). Colors, directions and texture coordinates never are. O(elements).
bool isLabel(const Attribute& attribute);

/// "_FEATURE_ID_0", "_BATCHID", "feature_id", "scalar_Classification": the names that formats and programs
/// give to labels, in either case, with or without a prefix and a number behind it.
bool isNameOfLabels(std::string_view name);

}  // namespace arete
