// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace arete {

/// Insertion order is reading order.
using Json = nlohmann::ordered_json;

}  // namespace arete
