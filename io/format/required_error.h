// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "engine/base/vec.h"

namespace arete {

/// The least error that anybody asks for within a box of plan coordinates, in the unit of the heights: 0 (or
/// less, or NaN) for full resolution, infinity where nobody asks. Null asks for everything. Who reads a part
/// of a model asks it of boxes around nodes, from several threads at once. What is read has the same minimal
/// cuts as the whole, with the same triangles in the same order, where these allow every triangle at least
/// the least error wanted of any box that it meets.
using RequiredError = std::function<double(const Box2&)>;

}  // namespace arete
