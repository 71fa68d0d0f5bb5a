// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/criteria/criterion.h"
#include "engine/cut/member_set.h"

namespace arete {

struct SaturatedMembers {
  MemberSet members;
  bool isComplete = true;  ///< as of a Cut
};

/// The nodes of the saturated cut. Under a budget, those of them with the largest ratio of saturated to
/// allowed error that fit. Precondition: the budget is at least the root's triangles. O(N) at most, parallel;
/// O(last band) for a uniform error; with a budget times log.
SaturatedMembers saturatedMembers(const MultiTriangulation& mt, const BoundedCriterion& criterion,
                                  std::optional<std::uint32_t> maxTriangles);

}  // namespace arete
