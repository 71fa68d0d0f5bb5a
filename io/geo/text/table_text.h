// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/geo/text/point_attributes.h"

namespace arete {

/// The names of the input's columns in a table that has columns of ours as well. A name that is already used
/// gets the suffix "_in". Case is ignored, as in databases.
std::vector<std::string> namesBeside(const PointAttributes& attributes,
                                     std::span<const std::string_view> ours);

/// Appends a field of CSV, in quotes if RFC 4180 requires them, or if it contains a '#', which begins a
/// comment.
void appendCsvField(std::string& line, std::string_view value);

}  // namespace arete
