// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "surface/model/attribute.h"

namespace arete {

/// The n-th number of all elements of an attribute; exact for every type.
double numberAt(const Attribute& attribute, std::size_t n);
/// Replaces it, rounded as Attribute::append() does; of a float, the largest is not exceeded.
void setNumber(Attribute& attribute, std::size_t n, double number);
std::size_t numberCount(const Attribute& attribute);

/// Turns the numbers into 32-bit floats; integers that are normalized become fractions.
/// @return False if a number changed by it.
bool makeFloat32(Attribute& attribute);

/// Turns 32-bit integers into 16-bit ones, if these hold all values, else into 32-bit floats if these do.
/// False, and nothing changes, if neither does.
bool makeSmaller(Attribute& attribute);

/// Replaces numbers that are infinite or none by 0. @return How many.
std::size_t makeFinite(Attribute& attribute);

}  // namespace arete
