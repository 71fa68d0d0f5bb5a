// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <utility>

#include "engine/base/box3.h"
#include "engine/base/vec.h"

namespace arete {

/// The error that a query requires of a part of a model: maps a box of its coordinates (of terrain in plan
/// coordinates and heights, which may be infinite) to the smallest error required within it, in the unit of
/// the errors. 0 (or less, or NaN) requires full resolution, infinity nothing. A null function requires
/// everything. Readers call it for boxes around nodes, from several threads at once.
///
/// The part that is read has the same minimal cut as the whole, with the same triangles in the same order,
/// for every criterion that allows each triangle at least the error required of any box that the triangle
/// meets.
using RequiredError = std::function<double(const Box3&)>;

/// Requires nothing anywhere. Only the root is read, which covers the whole model.
inline RequiredError requiredNowhere() {
  return [](const Box3&) { return std::numeric_limits<double>::infinity(); };
}

/// A box of the plan, with all heights.
inline Box3 overPlan(const Box2& box) {
  Box3 all;
  all.low.x = box.xMin;
  all.low.y = box.yMin;
  all.high.x = box.xMax;
  all.high.y = box.yMax;
  return all;
}

/// What does not depend on heights: `required` maps a box of the plan.
template <class Required>
RequiredError requiredInPlan(Required required) {
  return [required = std::move(required)](const Box3& box) {
    return required(Box2{box.low.x, box.low.y, box.high.x, box.high.y});
  };
}

}  // namespace arete
