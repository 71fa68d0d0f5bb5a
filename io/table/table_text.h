// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/table/point_attributes.h"

namespace arete {

/// The names of columns that stand beside ours in a table: one of ours, or of another, gets "_in" behind it.
/// Upper and lower case are alike, as in databases.
std::vector<std::string> namesBeside(const PointAttributes& attributes,
                                     std::span<const std::string_view> ours);

/// Appends a field of CSV, in quotes where RFC 4180 (or our own comments) want them.
void appendCsvField(std::string& line, std::string_view value);

}  // namespace arete
