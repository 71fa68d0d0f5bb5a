// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// Cut::missing. @param isRefined the cut was refined in an order until a budget or a deadline ended it
/// O(front), parallel; O(1) where the MT is whole.
std::vector<std::uint32_t> missingIn(const MultiTriangulation& mt, const Criterion& criterion, bool isRefined,
                                     const Cut& cut);

}  // namespace arete
