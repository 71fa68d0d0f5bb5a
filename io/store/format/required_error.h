// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "engine/base/vec.h"

namespace arete {

/// The error that a query requires of a part of a model: maps a box of plan coordinates to the smallest error
/// required within it, in the unit of the heights. 0 (or less, or NaN) requires full resolution, infinity
/// nothing. A null function requires everything. Readers call it for boxes around nodes, from several threads
/// at once.
///
/// The part that is read has the same minimal cut as the whole, with the same triangles in the same order,
/// for every criterion that allows each triangle at least the error required of any box that the triangle
/// meets.
using RequiredError = std::function<double(const Box2&)>;

}  // namespace arete
