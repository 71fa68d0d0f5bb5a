// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "io/query/attributes/attribute_deviations.h"

namespace arete {

/// A table, a line for each attribute, and where the largest is.
std::string attributeReportText(const AttributeReport& report, const std::string& unitOfLengths);

/// For `arete measure --json`: `within`, and for each attribute its figures; what is infinite is null.
nlohmann::ordered_json toJson(const AttributeReport& report);

}  // namespace arete
