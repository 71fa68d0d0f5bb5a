// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "surface/model/attribute.h"

namespace arete {

/// Adds the average of three elements of an attribute of the same kind: of numbers the weighted mean, of a
/// direction one of the length of the heaviest element's, and of labels, and of the sign of a tangent, those
/// of the heaviest element, the first of equal ones. An element of weight 0 may be any, also one that occurs
/// twice. Preconditions: `isOfLabels` is isLabel(from), which takes all elements to know; the weights are not
/// negative and their sum is 1. O(components).
void appendAverage(Attribute& to, const Attribute& from, const std::array<std::uint32_t, 3>& elements,
                   const std::array<double, 3>& weights, bool isOfLabels);

}  // namespace arete
