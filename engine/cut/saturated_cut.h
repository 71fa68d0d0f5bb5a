// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/cut/member_set.h"

namespace arete {

struct SaturatedMembers {
  MemberSet members;
  bool isComplete = true;  ///< as of a Cut
};

/// The nodes of a saturated cut, as many as the budget holds. Preconditions: the criterion is monotone, the
/// budget holds the root.
SaturatedMembers saturatedMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                  std::optional<std::uint32_t> maxTriangles);

}  // namespace arete
